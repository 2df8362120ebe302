// Texts: what gains, signals and equations mean.

export const explain = {};
