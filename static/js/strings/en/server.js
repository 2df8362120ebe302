// Texts: running on the server, and the jobs page.

export const server = {};
