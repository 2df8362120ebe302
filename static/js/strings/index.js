// Every text of the page, in the reader's language. Another language is another folder like en/.

import { en } from "./en/index.js";

export const strings = en;
