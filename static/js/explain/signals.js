// What the texts about signals, figures and schemes rest on: their equations, units and places in the paper.

/** Signals by name; `source` is an equation or figure of the paper, null where the paper has none. */
export const SIGNALS = {
  e: { equations: ["e = q − q_d"], unit: "°", source: "7" },
  q: { equations: ["q = q_d + e"], unit: "°", source: "7, 24" },
  de: { equations: ["dot(e) = dot(q) − dot(q)_d"], unit: "°/s", source: "7" },
  z: { equations: ["z = q − hat(q)", "dot(ξ) = z"], unit: "°", source: "21" },
  s: { equations: ["s = dot(q) − dot(q)_r = dot(e) + Λ e", "s_o = dot(q)_o − dot(q)_r"], unit: "rad/s", source: "6, 15" },
  tau: { equations: ["τ = − K s + Y hat(θ)"], unit: "N·m", source: "3, 13" },
  voltage: { equations: ["v = frac(R_a; r K_a) τ = frac(τ; 16.952)"], unit: "V", source: "1" },
  theta_hat: { equations: ["tilde(θ) = hat(θ) − θ"], unit: null, source: "2" },
  norm: { equations: ["sqrt(frac(1; 18) Σ_{i = 1}^{18} { ( tilde(θ)_i / θ_i ) }^2)"], unit: null, source: null },
  torque_parts: {
    equations: ["τ = H ( q ) ddot(q) + C ( q , dot(q) ) dot(q) + D dot(q) + f_c ( dot(q) ) + g ( q )"],
    unit: "N·m",
    source: "1, 2",
  },
  phase_plane: { equations: ["s = 0 ⇔ dot(e) = − Λ e"], unit: "°, °/s", source: "5, 6" },
  index: { equations: ["I ( x ) = sqrt(frac(1; k) Σ_{i = 0}^{k − 1} x_i^2)"], unit: null, source: null },
};

/** The signal that a figure shows, by the figure's identifier or its beginning. */
const FIGURES = [
  ["tracking_errors", "e"],
  ["velocity_errors", "de"],
  ["positions", "q"],
  ["observer_errors", "z"],
  ["torque_parts", "torque_parts"],
  ["torques", "tau"],
  ["estimates", "theta_hat"],
  ["sliding", "s"],
  ["voltage", "voltage"],
  ["phase", "phase_plane"],
  ["parameter_error", "norm"],
];

/** Name of the signal that a figure shows; null for a figure without a text. */
export function signalOf(figure) {
  return FIGURES.find(([start]) => figure.startsWith(start))?.[1] ?? null;
}

/** Equations of a scheme's three choices: velocity, feedback, adaptation. */
export const SCHEMES = {
  proposed: {
    velocity: ["dot(q)_o = ζ + K_d z", "ζ = dot(q)_d − Λ_x e + K_d Λ_z ξ", "dot(hat(q)) = ζ + Λ_z z + K_d z", "dot(ξ) = z"],
    feedback: ["τ = − K_v s_o + Y_o hat(θ)_o", "s_o = dot(q)_o − dot(q)_r", "dot(q)_r = dot(q)_d − Λ e"],
    adaptation: [
      "dot(hat(θ))_o = − Γ ( β w + Y_o^T s_o + f_b )",
      "dot(w) = − λ w + γ hat(Y)_f^T ε + Z dot(hat(θ))_o",
      "dot(Z) = − λ Z + γ hat(Y)_f^T hat(Y)_f",
    ],
    sources: { velocity: "21–23", feedback: "13, 15", adaptation: "14, 16–20" },
    mended: ["velocity"],
  },
  tang_arteaga: {
    velocity: ["dot(q)"],
    feedback: ["τ = − K_s s + Y hat(θ)", "s = dot(q) − a", "a = dot(q)_d − Λ_q e"],
    adaptation: [
      "dot(hat(θ)) = − δ g − Γ_1 Y^T s",
      "dot(g) = − λ_g g + γ_2 Y_f^T ε + Z dot(hat(θ))",
      "dot(Z) = − λ_g Z + γ_2 Y_f^T Y_f",
    ],
    sources: { velocity: "6", feedback: "8", adaptation: "9–12" },
    mended: ["feedback", "adaptation"],
  },
  slotine_li: {
    velocity: ["dot(q)"],
    feedback: ["τ = − K_s s + Y hat(θ)", "s = dot(q) − dot(q)_r", "dot(q)_r = dot(q)_d − Λ_e e"],
    adaptation: ["dot(hat(θ)) = − Γ_s Y^T s"],
    sources: { velocity: "6", feedback: "3, 5–7", adaptation: "4" },
    mended: ["adaptation"],
  },
};
