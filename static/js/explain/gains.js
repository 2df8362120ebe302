// What the texts about gains rest on: each gain's equation, where the paper has it, and the factors worth trying.
//
// `tries` are the factors on the paper's values that the buttons set; the texts say what these do. Between the factors of
// `range` a run of 12 s at a step of 1 ms reaches its end. A trial runs all of them.

const usual = { tries: [0.1, 10], range: [0, 100] };
const mended = true;

const BOUNDS = {
  tries: [0.01, 10],
  pointer: "/scheme/gains/projection",
  scales: ["upper_factor", "upper_hard_factor"],
  range: [0.003, 10],
};

const FILTER = { ...usual, equations: ["W(s) = frac(λ_f; s + λ_f)", "τ_f = W(s) τ"], range: [0.1, 10] };

/** By scheme and gain. `name` is the symbol; `source` is the equation's number in the paper; `mended` where the printed one has a misprint. */
export const GAINS = {
  proposed: {
    k_v: { name: "K_v", ...usual, equations: ["τ = − K_v s_o + Y_o hat(θ)_o"], source: "13" },
    lambda: { name: "Λ", ...usual, equations: ["dot(q)_r = dot(q)_d − Λ e", "s_o = dot(q)_o − dot(q)_r"], source: "15" },
    lambda_z: { name: "Λ_z", ...usual, equations: ["dot(hat(q)) = ζ + Λ_z z + K_d z"], source: "23", range: [0, 10] },
    lambda_x: { name: "Λ_x", ...usual, equations: ["ζ = dot(q)_d − Λ_x e + K_d Λ_z ξ"], source: "22", range: [0, 3] },
    k_d: {
      name: "K_d",
      equations: ["ζ = dot(q)_d − Λ_x e + K_d Λ_z ξ", "dot(q)_o = ζ + K_d z"],
      source: "22, 23",
      mended,
      tries: [0.1, 3],
      range: [0.2, 9],
    },
    beta: { name: "β", ...usual, equations: ["dot(hat(θ))_o = − Γ ( β w + Y_o^T s_o + f_b )"], source: "14" },
    gamma: { name: "γ", ...usual, equations: ["dot(Z) = − λ Z + γ hat(Y)_f^T hat(Y)_f"], source: "16, 17" },
    forgetting: {
      name: "λ",
      equations: ["dot(w) = − λ w + γ hat(Y)_f^T ε + Z dot(hat(θ))_o", "dot(Z) = − λ Z + γ hat(Y)_f^T hat(Y)_f"],
      source: "16, 17",
      tries: [0, 10],
      range: [0, 10],
    },
    filter_rad_s: { name: "λ_f", ...FILTER, source: "12" },
    rho: {
      name: "ρ",
      equations: ["f_{b i} = sign ( tilde(θ)_i ) ρ δ_i abs(β w_i + y_{a i}^T s_o)"],
      source: "19",
      tries: [0.4, 10],
      range: [0.4, 10],
    },
    gamma_adapt: { name: "Γ", ...usual, equations: ["dot(hat(θ))_o = − Γ ( β w + Y_o^T s_o + f_b )"], source: "14" },
    lower_margin: { name: "θ_2 − θ_1", ...usual, equations: ["δ_i = frac(θ_{2 i} − hat(θ)_i; θ_{2 i} − θ_{1 i})"], source: "20", range: [0.1, 10] },
    upper_factor: { name: "θ_3 / θ_o", ...BOUNDS, equations: ["δ_i = frac(hat(θ)_i − θ_{3 i}; θ_{4 i} − θ_{3 i})"], source: "20" },
    upper_hard_factor: { name: "θ_4 / θ_o", ...BOUNDS, equations: ["δ_i = frac(hat(θ)_i − θ_{3 i}; θ_{4 i} − θ_{3 i})"], source: "20" },
  },
  tang_arteaga: {
    k_s: { name: "K_s", ...usual, equations: ["τ = − K_s s + Y hat(θ)"], source: "8", mended, range: [0, 30] },
    lambda: { name: "Λ_q", ...usual, equations: ["a = dot(q)_d − Λ_q e", "s = dot(q) − a"], source: "8, 9", range: [0, 30] },
    delta: { name: "δ", ...usual, equations: ["dot(hat(θ)) = − δ g − Γ_1 Y^T s"], source: "9", range: [0, 1000] },
    gamma: { name: "γ_2", ...usual, equations: ["dot(Z) = − λ_g Z + γ_2 Y_f^T Y_f"], source: "9", range: [0, 1000] },
    forgetting: {
      name: "λ_g",
      equations: ["dot(g) = − λ_g g + γ_2 Y_f^T ε + Z dot(hat(θ))", "dot(Z) = − λ_g Z + γ_2 Y_f^T Y_f"],
      source: "9",
      mended,
      tries: [0, 10],
      range: [0, 10],
    },
    filter_rad_s: { name: "λ_f", ...FILTER, source: "12" },
    gamma_adapt: { name: "Γ_1", ...usual, equations: ["dot(hat(θ)) = − δ g − Γ_1 Y^T s"], source: "9" },
  },
  slotine_li: {
    k_s: { name: "K_s", ...usual, equations: ["τ = − K_s s + Y hat(θ)"], source: "3", range: [0, 30] },
    lambda: { name: "Λ_e", ...usual, equations: ["dot(q)_r = dot(q)_d − Λ_e e", "s = dot(q) − dot(q)_r"], source: "5, 6" },
    gamma_adapt: { name: "Γ_s", ...usual, equations: ["dot(hat(θ)) = − Γ_s Y^T s"], source: "4", mended },
  },
};
