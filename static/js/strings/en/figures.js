// Texts: what figures are called and their controls.

export const figures = {};
