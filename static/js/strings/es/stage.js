// Textos: por traducir; hasta entonces, en inglés.

export const stage = {};
