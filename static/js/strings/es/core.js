// Textos que el núcleo trae en inglés, por identificador.

const RAZONES = [
  [/^the tracking error of joint (\d+) exceeded (\S+) rad$/u, (joint, limit) => `el error de seguimiento de la articulación ${joint} superó ${limit} rad`],
  [/^a state or torque is no longer a finite number$/u, () => "un estado o un par ya no es un número finito"],
  [
    /^too stiff for the adaptive method: not done after (\d+) steps/u,
    (steps) =>
      `demasiado rígido para el método adaptativo: sin terminar tras ${steps} pasos; use rk4, un cambio de signo de la fricción ` +
      "más ancho o tolerancias más holgadas",
  ],
  [/^the adaptive step became too small/u, () => "el paso adaptativo se hizo demasiado pequeño: problema rígido o singular"],
];

const FEEDBACK = "Ganancia de realimentación sobre la variable deslizante: par por cada rad/s de s.";
const SURFACE = "Rapidez con que decae el error de seguimiento en la superficie deslizante s = 0.";
const ADAPTATION = "Ganancia de adaptación de cada parámetro: rapidez con que su estimación sigue el gradiente.";
const WEIGHT = "Peso del error de predicción recordado en la adaptación.";

export const core = {
  schemes: { proposed: "Propuesto", tang_arteaga: "Tang y Arteaga", slotine_li: "Slotine y Li" },
  gains: {
    k_s: FEEDBACK,
    k_v: FEEDBACK,
    lambda: SURFACE,
    lambda_z: "Observador: rapidez con que decae su error.",
    lambda_x:
      "Observador: intensidad con que entra el error de seguimiento (elegida igual a la Λ del artículo, que la omite).",
    k_d: "Observador: ganancia sobre su error (elegida; el artículo la omite).",
    delta: WEIGHT,
    beta: WEIGHT,
    gamma: "Intensidad con que los nuevos errores de predicción entran en la memoria.",
    forgetting: "Rapidez con que se desvanece la memoria de los errores de predicción.",
    filter_rad_s: "Ancho de banda del filtro que evita medir la aceleración.",
    rho: "Intensidad de la proyección al final de su margen.",
    gamma_adapt: ADAPTATION,
    lower_margin: "Anchura del margen por debajo de cero en el que la proyección alcanza toda su intensidad.",
    upper_factor: "Cota superior como múltiplo del valor nominal de cada parámetro.",
    upper_hard_factor: "Dónde acaba el margen superior, como múltiplo del valor nominal de cada parámetro.",
  },
  parameters: {
    θ1: "inercia, factor de cos²(q2+q3) en H11",
    θ2: "inercia, acoplamiento de las articulaciones 2 y 3",
    θ3: "inercia, factor de sen 2q2 en H11",
    θ4: "inercia, factor de cos² q2 en H11",
    θ5: "inercia, primer momento a lo largo del antebrazo",
    θ6: "inercia, factor de sen 2(q2+q3) en H11",
    θ7: "inercia, primer momento transversal al antebrazo",
    θ8: "inercia en torno a la articulación 1, parte constante",
    θ9: "inercia en torno a la articulación 2, parte constante",
    θ10: "inercia en torno a la articulación 3",
    θ11: "fricción viscosa, articulación 1",
    θ12: "fricción viscosa, articulación 2",
    θ13: "fricción viscosa, articulación 3",
    θ14: "fricción de Coulomb, articulación 1",
    θ15: "fricción de Coulomb, articulación 2",
    θ16: "fricción de Coulomb, articulación 3",
    θ17: "gravedad, brazo",
    θ18: "gravedad, antebrazo",
    "two_link.θ1": "inercia en torno a la articulación 1, parte constante",
    "two_link.θ2": "inercia en torno a la articulación 2",
    "two_link.θ3": "inercia, primer momento a lo largo del segundo eslabón",
    "two_link.θ4": "inercia, primer momento transversal al segundo eslabón",
    "two_link.θ5": "fricción viscosa, articulación 1",
    "two_link.θ6": "fricción viscosa, articulación 2",
    "two_link.θ7": "fricción de Coulomb, articulación 1",
    "two_link.θ8": "fricción de Coulomb, articulación 2",
    "two_link.θ9": "gravedad, primer eslabón con el segundo en su extremo",
    "two_link.θ10": "gravedad a lo largo del segundo eslabón",
    "two_link.θ11": "gravedad transversal al segundo eslabón",
    "pendulum.θ1": "inercia en torno al eje",
    "pendulum.θ2": "fricción viscosa",
    "pendulum.θ3": "fricción de Coulomb",
    "pendulum.θ4": "gravedad",
  },
  joints: { waist: "cintura", shoulder: "hombro", elbow: "codo", pivot: "eje" },
  robots: {
    crs_a465: "CRS A465, tres primeras articulaciones",
    two_link: "Brazo plano de dos eslabones",
    pendulum: "Péndulo",
  },
  presets: {
    proposed: "Esquema propuesto, con observador",
    tang_arteaga: "Tang y Arteaga (1994)",
    slotine_li: "Slotine y Li (1987)",
    proposed_from_rest: "Esquema propuesto, desde el reposo",
    tang_arteaga_from_rest: "Tang y Arteaga, desde el reposo",
    slotine_li_from_rest: "Slotine y Li, desde el reposo",
    proposed_heavier_arm: "Esquema propuesto, brazo más pesado",
    two_link_textbook: "Brazo de dos eslabones del libro",
    two_link_proposed: "Brazo de dos eslabones, esquema propuesto",
    pendulum_slotine_li: "Péndulo, Slotine y Li",
  },
  presetDescriptions: {
    proposed: "El controlador del propio artículo: sin sensor de velocidad, adaptación compuesta con proyección.",
    tang_arteaga: "Velocidad medida, adaptación compuesta a partir de los errores de seguimiento y de predicción.",
    slotine_li: "Velocidad medida, adaptación según el gradiente del error de seguimiento.",
    proposed_from_rest: "Como el propuesto, pero el brazo arranca en reposo.",
    tang_arteaga_from_rest: "Como Tang y Arteaga, pero el brazo arranca en reposo.",
    slotine_li_from_rest: "Como Slotine y Li, pero el brazo arranca en reposo.",
    proposed_heavier_arm: "El controlador no sabe que la inercia es un 30 % y la gravedad un 50 % mayor que la nominal.",
    two_link_textbook: "El libro de Slotine y Li, sección 9.2: su brazo, horizontal y sin fricción, con sus ganancias.",
    two_link_proposed: "Un brazo plano con gravedad y fricción bajo el controlador del artículo, sin sensor de velocidad.",
    pendulum_slotine_li: "Una articulación y cuatro parámetros, para las primeras lecciones.",
  },
  reason: (text) => {
    for (const [pattern, say] of RAZONES) {
      const found = pattern.exec(text);
      if (found) {
        return say(...found.slice(1));
      }
    }
    return text;
  },
};
