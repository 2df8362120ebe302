// Textos: qué significan las ganancias, las señales y las ecuaciones.

import { gains } from "./explain/gains.js";
import { glossary } from "./explain/glossary.js";
import { signals } from "./explain/signals.js";
import { why } from "./explain/why.js";

export const explain = {
  about: (name) => `Sobre ${name}`,
  close: "Cerrar",
  source: (number) => `Artículo, ec. ${number}.`,
  mended: "La ecuación impresa tiene una errata; esta es la forma que se calcula.",
  noSource: "No está en el artículo.",
  unit: (unit) => `Unidad: ${unit}.`,
  noUnit: "Sin unidad propia.",
  tooSmall: (factor) => `Pequeña (× ${factor})`,
  tooLarge: (factor) => `Grande (× ${factor})`,
  range: (unit, paper, low, high) => `Valor del artículo: ${paper}${unit}. Permitido: de ${low} a ${high}${unit}.`,
  perParameter: (low, high) => `de ${low} a ${high}, una por parámetro`,
  tried: (low, high) => `Las simulaciones llegan al final con entre ${low} y ${high} veces el valor del artículo.`,
  tryIt: "Pruébalo",
  trySmall: (factor) => `× ${factor}`,
  tryLarge: (factor) => `× ${factor}`,
  tryBack: "Volver",
  trySmallLabel: (name, factor) => `Poner ${name} a ${factor} veces el valor del artículo`,
  tryBackLabel: (name) => `Devolver ${name} a lo que era`,
  indices: (joints) => `I(e) = ${joints}°`,
  now: (text) => `Ahora: ${text}`,
  before: (text) => `Antes: ${text}`,
  computing: "calculando…",
  diverged: (time) => `la simulación diverge a los ${time}`,
  basis: "Comprobado simulándolo con todo lo demás como en el artículo (12 s, pasos de 1 ms).",
  numbers: "Sus números ahora",
  schemeNames: { proposed: "esquema propuesto", tang_arteaga: "Tang y Arteaga", slotine_li: "Slotine y Li" },
  choices: { velocity: "Velocidad que usa", feedback: "Ley de realimentación", adaptation: "Ley de adaptación" },
  gains,
  signals,
  glossary,
  why,
};
