// Which figures the page shows, in groups and in order, and what each can do beyond being drawn.
//
// What a figure contains and how it looks is the core's; the page only asks for those that the core lists.

/** Groups in the order of the page. */
export const GROUPS = [
  { id: "motion", figures: ["tracking_errors", "velocity_errors", "positions", "phase_plane"] },
  { id: "effort", figures: ["torques", "voltages", "torque_parts"] },
  { id: "adaptation", figures: ["estimates", "parameter_error_norm", "sliding_variables", "observer_errors"] },
];

/** The paper's own figures of estimates: not on the page, where one figure shows all eighteen, but among the exports. */
export const PAPER_ESTIMATES = ["estimates_1", "estimates_2", "estimates_3"];

/**
 * `symlog`: the axis may be symmetric-logarithmic; `focus`: shows one run at a time; `wide`: takes the whole width;
 * `plane`: has no time axis, its abscissa is the figure named.
 */
const TRAITS = {
  tracking_errors: { symlog: true },
  velocity_errors: { symlog: true },
  observer_errors: { symlog: true },
  sliding_variables: { symlog: true },
  parameter_error_norm: { symlog: true },
  phase_plane: { plane: "tracking_errors" },
  torque_parts: { focus: true },
  estimates: { wide: true },
};

/** What a figure can do. */
export const traits = (id) => TRAITS[id] ?? {};

/** Identifiers of the page's figures that the core draws. */
export function available(description) {
  const known = new Set(description.figures.map(({ id }) => id));
  return GROUPS.flatMap(({ figures }) => figures).filter((id) => known.has(id));
}
