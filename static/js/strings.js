// Every text of the page in one place, so that another language is another file like this.

export const strings = {
  skip: "Skip to the results",
  tagline: "Adaptive control of a robot arm, live",
  intro:
    "Three controllers make the same simulated robot arm follow the same path without knowing its masses and frictions: " +
    "they learn 18 parameters on the way. Move a slider and every curve and number is computed again, here in your browser. " +
    "The proposed scheme does it without measuring velocity.",
  sections: "Sections",
  controls: "Controls",
  setup: "Setup",
  gains: "Gains",
  results: "Results",
  tables: "Tables",
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
  completed: (milliseconds) => `done in ${milliseconds} ms`,
  diverged: (time, reason) => `diverged at ${time}: ${reason}`,
  divergedShort: (time) => `diverged at ${time}`,
  failed: (message) => `failed: ${message}`,
  hash: "hash",
  hashTitle: (hash) => `Trajectory hash ${hash}. Equal hashes mean equal samples, to the bit, on any machine. Click to copy.`,
  copied: "Trajectory hash copied.",

  stateRunning: "computing…",
  stateReady: (milliseconds) => `up to date · ${milliseconds} ms`,
  announceReady: (parts) => `Results updated. ${parts}`,

  figure: {
    tracking_errors: "Joint tracking errors",
    velocity_errors: "Joint velocity errors",
    observer_errors: "Observer errors",
    estimates_1: "Estimates θ1 to θ6",
    estimates_2: "Estimates θ7 to θ12",
    estimates_3: "Estimates θ13 to θ18",
    torques: "Joint torques",
  },
  paperFigure: (number) => `Paper fig. ${number}`,
  figureAlt: (title, seconds, summary) => `${title} over ${seconds}. ${summary}`,
  altIndices: (scheme, unit, numbers) => `${scheme}: root mean square ${numbers} ${unit}, joints 1 to 3.`,
  altPeaks: (scheme, unit, numbers) => `${scheme}: peaks ${numbers} ${unit}, joints 1 to 3.`,
  altEnd: (scheme, numbers) => `${scheme} ends at ${numbers}.`,
  noObserver: "The scheme with an observer is hidden.",

  table1: "Performance index of the joint errors, °",
  table2: "Performance index of the joint velocity errors, °/s",
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
    e_peak_deg: "Peak |e|, °",
    z_peak_deg: "Peak |z|, °",
    tau_peak_nm: "Peak |τ|, N·m",
    voltage_peak_v: "Peak motor voltage, V",
    settling_e_s: "|e| settles, s",
    settling_de_s: "|ė| settles, s",
  },
  settlingNote: (e, de) => `Settled: |e| stays within ${e}°, |ė| within ${de}°/s. A dash means never, or does not apply.`,

  colophon: (version) =>
    `adaptarm core ${version}. Computed in this browser by the same Rust core as on the server; nothing is sent anywhere.`,
  moduleMissing: (reason) =>
    `The simulation module did not load (${reason}). If you serve this page from source, run “cargo xtask dist” and reload.`,
  workerRestarted: "A background worker stopped and was restarted; its run was started again.",
  workerGone: "background workers keep stopping",
  stateDropped: "What was remembered from the last visit could not be used and was replaced by the paper's study.",
  dismiss: "Dismiss",
};
