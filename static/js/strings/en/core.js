// Texts that the core brings in English: other languages translate them here by identifier; English leaves them as they are.
//
// `gains` by scheme and name (a name alone serves all schemes), `parameters` by symbol, the rest by identifier.

export const core = {
  schemes: {},
  gains: {},
  parameters: {},
  joints: {},
  robots: {},
  presets: {},
  presetDescriptions: {},
  reason: (text) => text,
};
