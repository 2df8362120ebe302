// Texts: the guided tour of the paper.

export const tour = {};
