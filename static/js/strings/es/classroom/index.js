// Los textos de las páginas del aula.

import { learn } from "./learn.js";
import { shared } from "./shared.js";
import { teach } from "./teach.js";

export const classroom = { ...shared, ...learn, ...teach };
