// Textos: qué articulación sigue peor y por qué. Todos sus números salen de las simulaciones que se muestran.

const part = {
  inertia: "inercia",
  coriolis: "par de Coriolis y centrífugo",
  viscous_friction: "fricción viscosa",
  dry_friction: "fricción seca",
  gravity: "gravedad",
};

export const why = {
  title: (joint) => `¿Por qué es la peor la articulación ${joint}?`,
  titleNone: "¿Qué articulación es la peor y por qué?",
  choose: "Esquema",
  worst: (scheme, joint, index, others) =>
    `${scheme}: la articulación ${joint} es la que peor sigue, con I(e) = ${index}° frente a ${others}.`,
  other: (joint, index) => `${index}° en la ${joint}`,
  and: " y ",
  explanation:
    "Lo que los estimados no dan, debe darlo la realimentación: tira con K Λ newton metro por radián de error fijo. Así, el error " +
    "de una articulación es más o menos el par que falta dividido por K Λ.",
  balance: (joint, missing, stiffness) =>
    `En la articulación ${joint} la realimentación tuvo que dar ${missing} N·m (media cuadrática) y tira con K Λ = ${stiffness} N·m/rad.`,
  heaviest: "Es la articulación a la que más par le falta.",
  softest: "Es la articulación con la realimentación más blanda.",
  both: "Es a la que más par le falta y la de realimentación más blanda.",
  neither: "A otra le falta más par y otra es más blanda; decide el cociente de ambos.",
  largestPart: (joint, name, rms, total) =>
    `La mayor parte de lo que necesita el movimiento de la articulación ${joint} es ${part[name]}: ${rms} de ${total} N·m (media cuadrática).`,
  wrong: (list) => `Los estimados que hay detrás, al final: ${list}.`,
  right: (list) => `Los estimados que hay detrás han llegado a menos de un 10 %: ${list}.`,
  estimate: (symbol, value, truth) => `${symbol} vale ${value} en vez de ${truth}`,
  diverged: (scheme, time) => `${scheme}: la simulación diverge a los ${time}, así que sus articulaciones no se pueden comparar.`,
  caption: "Articulación por articulación",
  quantity: "Media cuadrática de toda la simulación",
  rows: {
    index: "Índice de seguimiento I(e), °",
    stiffness: "K Λ, N·m/rad",
    missing: "Par de la realimentación, N·m",
    quotient: "Par de la realimentación / K Λ, °",
    total: "Par entero, N·m",
  },
  part: (name) => `de él ${part[name]}, N·m`,
  note: "Las partes son las del brazo verdadero a lo largo de su movimiento. Como medias cuadráticas no suman el total: a ratos se cancelan.",
};
