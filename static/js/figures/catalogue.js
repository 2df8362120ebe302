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
 * `focus`: shows one run at a time; `wide`: takes the whole width; `grid`: its panels stand side by side where there is
 * room, so its height is the core's business; `plane`: has no time axis.
 */
const TRAITS = {
  positions: { wide: true },
  phase_plane: { wide: true, grid: true, plane: true },
  torque_parts: { wide: true, focus: true },
  estimates: { wide: true, grid: true },
  parameter_error_norm: { wide: true },
};

/** What a figure can do. */
export const traits = (id) => TRAITS[id] ?? {};

/** Identifiers of the page's figures that the core draws. */
export function available(description) {
  const known = new Set(description.figures.map(({ id }) => id));
  return GROUPS.flatMap(({ figures }) => figures).filter((id) => known.has(id));
}
