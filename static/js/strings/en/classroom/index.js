// English texts of the classroom's pages.

import { learn } from "./learn.js";
import { shared } from "./shared.js";
import { teach } from "./teach.js";

export const classroom = { ...shared, ...learn, ...teach };
