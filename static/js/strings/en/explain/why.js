// Texts: which joint tracks worst, and why. Every number in them comes from the runs that are shown.

const part = {
  inertia: "inertia",
  coriolis: "Coriolis and centrifugal torque",
  viscous_friction: "viscous friction",
  dry_friction: "dry friction",
  gravity: "gravity",
};

export const why = {
  title: (joint) => `Why is joint ${joint} worst?`,
  titleNone: "Which joint is worst, and why?",
  choose: "Scheme",
  worst: (scheme, joint, index, others) => `${scheme}: joint ${joint} tracks worst, with I(e) = ${index}° against ${others}.`,
  other: (joint, index) => `${index}° in joint ${joint}`,
  and: " and ",
  explanation:
    "What the estimates do not supply, the feedback must: it pulls with K Λ newton metres per radian of standing error. So the " +
    "error of a joint is about the torque that is missing, divided by K Λ.",
  balance: (joint, missing, stiffness) =>
    `In joint ${joint} the feedback had to supply ${missing} N·m (root mean square) and pulls with K Λ = ${stiffness} N·m/rad.`,
  heaviest: () => "It is the joint that lacks most torque.",
  softest: () => "It is the joint with the softest feedback.",
  both: "It lacks most torque and has the softest feedback.",
  neither: "Another joint lacks more torque and another is softer; the quotient of the two decides.",
  largestPart: (joint, name, rms, total) =>
    `The largest part of what the motion of joint ${joint} needs is ${part[name]}: ${rms} of ${total} N·m (root mean square).`,
  wrong: (list) => `The estimates behind it at the end: ${list}.`,
  right: (list) => `The estimates behind it have come within 10 %: ${list}.`,
  estimate: (symbol, value, truth) => `${symbol} is ${value} instead of ${truth}`,
  diverged: (scheme, time) => `${scheme}: the run diverges at ${time}, so its joints cannot be compared.`,
  caption: "Joint by joint",
  quantity: "Root mean square over the run",
  rows: {
    index: "Tracking index I(e), °",
    stiffness: "K Λ, N·m/rad",
    missing: "Torque from feedback, N·m",
    quotient: "Torque from feedback / K Λ, °",
    total: "Whole torque, N·m",
  },
  part: (name) => `of it ${part[name]}, N·m`,
  note: "The parts are those of the true arm along its motion. As root mean squares they do not add up: at times they cancel.",
};
