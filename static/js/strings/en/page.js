// The playground's own texts: frame, setup, gains, figures, tables.

export const page = {
  titles: {
    playground: "adaptarm: adaptive control of a robot arm, live",
    jobs: "adaptarm: jobs",
  },
  descriptions: {
    playground:
      "Three adaptive controllers on a simulated CRS A465 robot arm: change any gain and see errors, torques and estimates follow.",
    jobs: "Simulations of a robot arm that this server runs: their progress and their results.",
  },
  skip: "Skip to the results",
  tagline: "Adaptive control of a robot arm, live",
  intro:
    "Three controllers make the same simulated robot arm follow the same path without knowing its masses and frictions: " +
    "they learn 18 parameters on the way. Move a slider and every curve and number is computed again, here in your browser. " +
    "The proposed scheme does it without measuring velocity.",
  pages: { playground: "Playground", classroom: "Classroom", jobs: "Jobs", api: "API" },
  pagesLabel: "Pages",
  toolbar: "Tools",
  sections: "Sections",
  controls: "Controls",
  setup: "Setup",
  gains: "Gains",
  results: "Results",
  tables: "Tables",
  language: "Language",
  themeDark: "Dark theme",
  themeLight: "Light theme",

  study: "Study",
  studies: {
    paper: "The paper's study",
    from_rest: "From rest",
    heavier_arm: "Heavier arm",
  },
  studyHelp: {
    paper: "The arm starts with the desired velocity; the simulated arm is the nominal one.",
    from_rest: "As in the paper, but the arm starts standing still.",
    heavier_arm: "Inertia is 30 % and gravity 50 % above nominal. The controllers are not told.",
    custom: "Your own settings. Choosing a study replaces them.",
  },
  studyCustom: "Custom",
  duration: "Duration",
  step: "Step",
  friction: "Friction width",
  frictionHelp: "Speed over which dry friction changes sign; 0 is the true sign.",
  start: "Arm starts",
  startDesired: "at the desired velocity",
  startRest: "standing still",
  resetAll: "Reset everything",
  resetScheme: (scheme) => `Reset the gains of ${scheme}`,
  reset: (label) => `Reset ${label}`,
  schemes: "Control schemes",
  joint: (number, name) => `Joint ${number}, ${name}`,
  scalarGains: "Adaptation and filters",
  projection: "Projection bounds",
  eighteen: (count) => `${count} values, one per parameter`,
  exactly: (label) => `${label}, exact value`,

  show: (scheme) => `Show ${scheme} in the figures`,
  waiting: "waiting",
  running: (percent) => `running, ${percent} %`,
  stop: "Stop",
  runAgain: "Run again",
  stoppedAt: (percent) => `stopped at ${percent} %`,
  ended: "completed",
  completed: (milliseconds) => `done in ${milliseconds} ms`,
  diverged: (time, reason) => `diverged at ${time}: ${reason}`,
  divergedShort: (time) => `diverged at ${time}`,
  failed: (message) => `failed: ${message}`,
  hash: "hash",
  hashTitle: (hash) => `Trajectory hash ${hash}. Equal hashes mean equal samples, to the bit, on any machine. Click to copy.`,
  copied: "Trajectory hash copied.",

  stateRunning: "computing…",
  stateReady: (milliseconds) => `up\u00a0to\u00a0date · ${milliseconds}\u00a0ms`,
  announceReady: (parts) => `Results updated. ${parts}`,

  pinnedFigure: "Pinned figure",

  table1: "Performance index of the joint errors,\u00a0°",
  table2: "Performance index of the joint velocity errors,\u00a0°/s",
  tableOther: "Peaks and settling",
  jointShort: (number) => `Joint ${number}`,
  paperValue: (value) => `paper ${value}`,
  ratio: (ratio) => `ratio ${ratio}`,
  tableNote:
    "Large: this run. Small: the paper's value and our value divided by it. " +
    "The paper's values hold for its own settings.",
  scheme: "Scheme",
  quantity: "Joints 1, 2, 3",
  rows: {
    e_peak_deg: "Peak |e|,\u00a0°",
    z_peak_deg: "Peak |z|,\u00a0°",
    tau_peak_nm: "Peak |τ|,\u00a0N·m",
    voltage_peak_v: "Peak motor voltage,\u00a0V",
    settling_e_s: "|e| settles,\u00a0s",
    settling_de_s: "|ė| settles,\u00a0s",
  },
  settlingNote: (e, de) => `Settled: |e| stays within ${e}°, |ė| within ${de}°/s. A dash means never, or does not apply.`,

  colophon: (version) =>
    `adaptarm core ${version}. Computed in this browser by the same Rust core as on the server. Nothing is sent anywhere, unless you run it on the server.`,
  moduleMissing: (reason) =>
    `The simulation module did not load (${reason}). If you serve this page from source, run “cargo xtask dist” and reload.`,
  workerRestarted: "A background worker stopped and was restarted; its run was started again.",
  workerGone: "background workers keep stopping",
  stateDropped: "What was remembered from the last visit could not be used and was replaced by the paper's study.",
  dismiss: "Dismiss",
};
