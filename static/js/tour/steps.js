// The steps of the tour: what each one is about and where on the page it shows. Texts: strings/*/tour.js, by the same id.

const figure = (id) => `.results figure-card[data-figure="${id}"]`;
const INDICES = "#tables .table-pair";

/** `targets` are selectors in order of preference; a claim has its replication's identifier as `id`. */
export const STEPS = [
  { id: "arm", targets: ["#stage", figure("torques")] },
  { id: "task", targets: ["#stage", figure("tracking_errors")] },
  { id: "schemes", targets: ["#scheme-cards"] },
  { id: "ultimately_bounded", claim: true, targets: [figure("tracking_errors")] },
  { id: "slotine_li_converges", claim: true, targets: [figure("tracking_errors")] },
  { id: "errors_look_alike", claim: true, targets: [figure("tracking_errors")] },
  { id: "slotine_li_worst", claim: true, targets: ['[data-table="index_e_deg"]'] },
  { id: "similar_to_tang_arteaga", claim: true, targets: [INDICES] },
  { id: "slotine_li_settles_last", claim: true, targets: ['[data-table="other"]'] },
  { id: "third_joint_velocity_stays", claim: true, targets: [figure("velocity_errors")] },
  { id: "observer_replaces_the_sensor", claim: true, targets: ['[data-table="index_de_deg_s"]'] },
  { id: "observer_peaks", claim: true, targets: [figure("observer_errors")] },
  { id: "estimates_become_constant", claim: true, targets: [figure("estimates"), "#estimates"] },
  { id: "closest_estimates", claim: true, targets: [figure("estimates"), "#estimates"] },
  { id: "proposed_best", claim: true, targets: [INDICES] },
  { id: "now", targets: ["#why"] },
];

/** The durations that a claim can be looked at over, s: the study's, and one after which much has been learned. */
export const DURATIONS = [12, 600];
