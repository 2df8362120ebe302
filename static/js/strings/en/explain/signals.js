// Texts: the signals, the figures that show them, and the three choices of each scheme.

export const signals = {
  e: {
    name: "the tracking error e",
    what: "Where a joint is minus where it should be. Everything the controllers do has the aim to make it small.",
    read: "A curve around zero is good. Its root mean square over the samples is the performance index I(e) of Table 1.",
  },
  q: {
    name: "the joint position q",
    what: "The angle of each joint beside the desired one: a sum of three sines around the starting position.",
    read: "The curves lie on one another unless something is badly wrong; the tracking error shows the difference.",
  },
  de: {
    name: "the velocity error ė",
    what: "How fast a joint turns minus how fast it should. It is computed from the true velocity, also for the scheme that does not measure it.",
    read: "Its root mean square is the index of Table 2. A joint counts as settled once |ė| stays below 0.5 °/s.",
  },
  z: {
    name: "the observer error z",
    what: "The measured position minus the observer's position. Only the proposed scheme has an observer.",
    read: "A small z does not prove that the observed velocity is good: Λ_z alone can make z small without touching the motion.",
  },
  s: {
    name: "the sliding variable s",
    what: "Velocity error and position error in one number. If s stays zero, the tracking error dies out by itself, at the rate Λ.",
    read: "The feedback torque is −K s, so that this curve, times K, is the torque that the estimates failed to supply.",
  },
  tau: {
    name: "the torque τ",
    what: "What the controller asks of each joint: feedback on s plus what the current estimates say that the motion needs.",
    read: "In a good run the curves of the three schemes lie almost on one another: the same motion needs the same torque.",
  },
  voltage: {
    name: "the motor voltage v",
    what: "The torque divided by 16.952 N·m/V: gear ratio times torque constant over armature resistance. The back electromotive force is left out, as in the paper.",
    read: "The paper's model lets the controller have any voltage; nothing is cut off.",
  },
  theta_hat: {
    name: "the estimates θ̂",
    what: "The 18 numbers the controller believes: inertias, viscous and dry friction, gravity. They start at zero; the line across is the truth.",
    read:
      "Good tracking does not need true estimates: it needs estimates whose torques add up. An estimate far from its line next to a small error shows just that.",
  },
  norm: {
    name: "the relative error of the estimates",
    what: "How far all 18 estimates together are from the truth: the root mean square of their relative errors. It starts at 1, for the estimates start at zero; small parameters count as much as large ones.",
    read: "It need not fall: with a gradient law the tracking error can vanish while this stays. One estimate far beyond a small true value is enough to raise it above 1.",
  },
  torque_parts: {
    name: "the parts of the torque",
    what: "The torque that the true arm needs for its motion, taken apart: inertia, Coriolis and centrifugal, viscous friction, dry friction, gravity.",
    read: "At every instant the parts add up to the torque. The largest part is the one whose parameters matter most.",
  },
  phase_plane: {
    name: "the phase plane",
    what: "Velocity error over tracking error, with time along the curve. The sliding surface s = 0 is a straight line through the origin; its slope is −Λ, so each scheme and joint has its own, and none is drawn.",
    read: "On its line a run slides into the origin. What keeps it circling instead is torque that is not yet learned.",
  },
  index: {
    name: "the performance index I",
    what: "Root mean square over k = 3000 samples from the start of the run: one number per joint for a whole curve.",
    read: "It weighs the start, when nothing is learned yet, as much as the end.",
  },
  schemes: {
    proposed: {
      velocity: "An observer supplies the velocity from positions alone.",
      feedback: "A sliding variable built with the observed velocity; the model's torque is taken along the reference motion.",
      adaptation: "Gradient plus remembered prediction errors; a projection keeps the estimates within bounds.",
    },
    tang_arteaga: {
      velocity: "The measured velocity.",
      feedback: "A sliding variable with the measured velocity, plus the model's torque.",
      adaptation: "Gradient plus remembered prediction errors, without projection.",
    },
    slotine_li: {
      velocity: "The measured velocity.",
      feedback: "A sliding variable with the measured velocity, plus the model's torque.",
      adaptation: "The gradient alone: an estimate moves only while there is tracking error.",
    },
  },
};
