// Texts: the guided tour of the paper. Claims and criteria are the core's, word for word, as a trial checks; the numbers found
// come from the core.

export const tour = {
  start: "Tour of the paper",
  close: "Close the tour",
  back: "Back",
  next: "Next",
  finish: "Finish",
  progress: (number, count) => `${number} of ${count}`,
  computing: "computing…",
  unfinished: "A run has no result yet, so nothing can be judged.",
  over: "Simulated:",
  seconds: (duration) => `${duration} s`,
  restore: "Bring back my settings",
  restoreOffer: "The tour has changed your settings.",
  restoreFailed: (message) => `Your settings could not be brought back: ${message}`,
  verdicts: { holds: "✓ Holds here", does_not_hold: "✗ Does not hold here", not_tested: "– Not tested" },
  found: (evidence) => `Found: ${evidence}.`,
  criterion: (text) => `Our criterion, for the paper states none: ${text}.`,
  evidence: (text) => text,
  sum: (holding, count) => `${holding} of ${count} claims hold in the runs that are shown now.`,
  steps: {
    arm: {
      title: "The arm",
      text: [
        "The CRS A465 has six joints; the paper moves the first three: the waist, the shoulder, the elbow. The true arm has 18 parameters: inertias, viscous and dry friction, gravity.",
        "The simulation knows them. The controllers do not: each starts with all 18 estimates at zero.",
      ],
    },
    task: {
      title: "The task",
      text: [
        "Each joint has to follow a sum of three sines with a period of 2π seconds. The arm starts on the path with the desired velocity: a choice made here, for the paper does not say.",
        "The tracking error e is where a joint is minus where it should be. The index I(e), the root mean square over 3000 samples, sums a whole run up in one number per joint.",
      ],
    },
    schemes: {
      title: "The three controllers",
      text: [
        "Slotine and Li (1987) learn from the tracking error alone. Tang and Arteaga (1994) also remember how wrong their torque predictions were. Both need the joint velocities.",
        "The paper's proposal does without: an observer guesses the velocities from the positions. The “i” of each card shows the equations.",
        "Now the paper's twelve claims. Each step sets the paper's own gains, points to where the claim shows, and lets the core judge the run.",
      ],
    },
    ultimately_bounded: { title: "The errors stay bounded" },
    slotine_li_converges: { title: "Slotine and Li converge" },
    errors_look_alike: { title: "The errors look alike" },
    slotine_li_worst: { title: "Slotine and Li track worst" },
    similar_to_tang_arteaga: { title: "As good as with a sensor" },
    slotine_li_settles_last: { title: "Slotine and Li settle last" },
    third_joint_velocity_stays: { title: "The third joint's velocity error stays" },
    observer_replaces_the_sensor: { title: "The observer replaces the sensor" },
    observer_peaks: { title: "The observer's peaks" },
    estimates_become_constant: { title: "The estimates become constant" },
    closest_estimates: { title: "The estimates come close" },
    proposed_best: { title: "The proposed scheme is ahead" },
    now: {
      title: "What now?",
      text: [
        "Move gains: set λ of the proposed scheme to 0 and watch most estimates find the truth; divide K_v by ten; start the arm standing still. The “i” beside each gain says what to expect and lets you try it.",
        "Marked on the page: why the worst joint is worst, answered for whatever you set.",
      ],
    },
  },
  claims: {
    ultimately_bounded: {
      claim: "The proposed scheme's tracking and observer errors are ultimately bounded.",
      criterion: "for every joint the index of e and of z over the second half is at most that over the first",
      why: "It holds over 12 s and over 600 s. One run is an example and no proof, and the paper does not print its proof.",
    },
    slotine_li_converges: {
      claim: "Slotine and Li's tracking errors tend to zero.",
      criterion: "for every joint I(e) over the second half is smaller than over the first",
      why: "12 s are less than two periods of the path: the two halves meet different parts of it, and the estimates are still on their way. Over 600 s the errors shrink in all joints.",
    },
    errors_look_alike: {
      claim: "The joint errors of the three controllers behave very much alike.",
      criterion: "for every joint the largest I(e) is within a factor of 2 of the smallest",
      why: "The shapes are alike, for the same motion needs the same torque. The sizes follow the stiffness K Λ of the feedback, which differs between the schemes by a factor of 9 to 12, and so do the errors: by 8 to 10.",
    },
    slotine_li_worst: {
      claim: "Slotine and Li's controller tracks worst of the three.",
      criterion: "its I(e) is the largest for every joint (the paper's own Table 1 denies this for joint 2)",
      why: "Its feedback K Λ is the softest of the three in every joint. The paper's own Table 1 says otherwise for joint 2, where it lists Slotine and Li as best.",
    },
    similar_to_tang_arteaga: {
      claim: "The proposed scheme performs much like Tang and Arteaga's, although it lacks the velocity sensor.",
      criterion: "I(e) and I(ė) of the two are within a factor of 2 for every joint",
      why: "Over 12 s it is joint 1 that differs, where Tang and Arteaga's feedback K Λ is nearly five times as stiff. Over 600 s all six ratios are within a factor of 2.",
    },
    slotine_li_settles_last: {
      claim: "The velocity errors of Slotine and Li's controller settle last.",
      criterion: "for every joint its ė enters the band of 0.5 °/s for good later than with both others",
      why: "With the softest feedback its velocity errors never stay within the band during 12 s. It still settles last over 600 s.",
    },
    third_joint_velocity_stays: {
      claim: "With Slotine and Li's controller the third joint's velocity error stays at a bounded level instead of vanishing.",
      criterion: "its I(ė3) over the last sixth is more than half of that over the whole run, and a larger share than with both others",
      why: "Over 12 s it looks like a level that stays. It is slow learning: over 600 s the last sixth has a quarter of the whole run's index, and the claim fails.",
    },
    observer_replaces_the_sensor: {
      claim: "The velocity errors confirm that the observer stands in well for a velocity sensor.",
      criterion: "for every joint I(ė) of the proposed scheme is at most twice Tang and Arteaga's and below Slotine and Li's",
      why: "Over 12 s only joint 1 spoils it, again where Tang and Arteaga's feedback is much stiffer. Over 600 s the claim holds.",
    },
    observer_peaks: {
      claim: "The observer errors stay below 0.023°, 0.027° and 0.019°.",
      criterion: "the peaks do not exceed these bounds as rounded (K_d was calibrated to them: no evidence for the claim)",
      why: "No evidence either way: the paper does not give the observer's gain K_d, and the one used here was chosen so that just these peaks come out.",
    },
    estimates_become_constant: {
      claim: "Only with Tang and Arteaga's and the proposed scheme do the estimates settle to constants.",
      criterion: "in the last sixth at least 16 of 18 estimates move less than 5 % of their range with these two, and fewer with Slotine and Li",
      why: "12 s are too short for any scheme: nearly all estimates still move. After 600 s 14 of the proposed scheme's have settled, 6 of Tang and Arteaga's, 11 of Slotine and Li's.",
    },
    closest_estimates: {
      claim: "Only the proposed scheme's estimates come close to some true values.",
      criterion: "at the end at least one of its estimates is within 10 % of the truth, and none of the other schemes' is",
      why: "After 12 s no estimate of any scheme is within 10 %. After 600 s five of the proposed scheme's are, but also one of Tang and Arteaga's and five of Slotine and Li's.",
    },
    proposed_best: {
      claim: "The performance indices show the proposed scheme ahead.",
      criterion: "it has the smallest index in more than half of the six entries of Tables 1 and 2 (the paper's own tables: 4 of 6)",
      why: "The stiffer feedback wins more than the better learning: Tang and Arteaga's is stiffer in joints 1 and 3, the proposed one in joint 2. Over 600 s it is ahead in three entries of six, still not more than half.",
    },
  },
};
