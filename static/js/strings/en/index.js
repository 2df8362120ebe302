// English, the language that every text is written in first.

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

export const en = { ...page, figures, stage, compare, server, explain, tour, errors, offline, core };
