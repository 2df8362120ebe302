// Texts: history, pins, links and files.

export const compare = {};
