// Texts: refusals of the core, in the reader's language.

export const errors = {};
