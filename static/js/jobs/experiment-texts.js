// Texts about experiments in the reader's language. The playground does not load them.

import { laidOver, language } from "../strings/index.js";
import { experiments as en } from "../strings/en/experiments.js";

const others = { es: async () => (await import("../strings/es/experiments.js")).experiments };

export const texts = language in others ? laidOver(en, await others[language]()) : en;
