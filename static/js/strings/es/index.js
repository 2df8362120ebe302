// Español: la segunda lengua. Lo que falte aquí se muestra en inglés.

import { compare } from "./compare.js";
import { core } from "./core.js";
import { errors } from "./errors.js";
import { explain } from "./explain.js";
import { figures } from "./figures.js";
import { offline } from "./offline.js";
import { page } from "./page.js";
import { server } from "./server.js";
import { stage } from "./stage.js";
import { tour } from "./tour.js";

export const es = { ...page, figures, stage, compare, server, explain, tour, errors, offline, core };
