// Texts: the arm and its playback.

export const stage = {};
