// Texts: what each gain does, and what a run shows when it is made small or large. A trial runs what is said here.

const feedback =
  "Gain of the feedback: how many newton metres answer each rad/s of the sliding variable s. Together with the slope Λ it is " +
  "a spring and a damper between the arm and its desired path; what the estimates do not know yet has to come from here.";
const slope =
  "Slope of the sliding surface: on s = 0 the tracking error decays by the factor e every 1/Λ seconds. It also sets how " +
  "stiffly the feedback pulls, because the torque for a standing error is K Λ e.";
const rate =
  "Adaptation gain of each parameter, one number for each of the 18: how fast its estimate moves when the sliding variable " +
  "says that the torque was wrong.";
const filter =
  "Bandwidth of the low-pass filter W(s). Filtering the model on both sides removes the joint acceleration, which nobody " +
  "measures, from the prediction error.";

export const gains = {
  proposed: {
    k_v: {
      what: feedback,
      small:
        "All joints track 2 to 4 times worse, but the larger errors teach more: after 12 s the estimates are nearer to the " +
        "truth than with the paper's value.",
      large:
        "All joints track 7 to 9 times better, and the estimates learn less, since there is less error to learn from. This " +
        "simulation has no sensor noise; on a real arm the gain multiplies the noise too.",
    },
    lambda: {
      what: slope,
      small: "The tracking errors grow about tenfold. What the estimates learn stays nearly the same.",
      large: "The tracking errors shrink about tenfold, and the torque peaks rise by a fifth to a third.",
    },
    lambda_z: {
      what:
        "Decay rate of the observer error z. The controller's velocity contains z and its integral only as z + Λ_z ξ, whose " +
        "motion does not depend on Λ_z at all.",
      small: "The peaks of z grow 3 to 4 times. Tracking, torques and indices stay as they were.",
      large: "The peaks of z shrink to about a ninth. Tracking, torques and indices stay as they were.",
    },
    lambda_x: {
      what:
        "How strongly the tracking error enters the observer. The paper uses it without giving a value: here it equals the " +
        "paper's Λ, and it does not follow Λ when that is changed.",
      small: "Tracking hardly changes (under 1 %), and the peaks of the observer error fall to a half or less.",
      large: "The run diverges within a tenth of a second, with a ten times finer step too: the loop itself is unstable.",
    },
    k_d: {
      what:
        "Bandwidth of the observed velocity: it follows the true one like a low-pass filter of this corner frequency. The " +
        "paper gives no value; this one was calibrated to the paper's peaks of z, so that their agreement is no evidence.",
      small:
        "The observed velocity lags so much that the torques swing to hundreds and thousands of N·m; joint 2 is off by " +
        "several degrees.",
      large:
        "The peaks of z fall to about a third; tracking gains less than 1 %. At ten times the paper's value a step of 1 ms is " +
        "too coarse for the observer and the run diverges; with a step of 0.1 ms it does not.",
    },
    beta: {
      what:
        "Weight of the remembered prediction error w in the adaptation. At 0 the estimates follow the gradient alone. Since w " +
        "is proportional to γ, only the product β γ counts.",
      small: "I(e) rises by 2 to 6 %: at the paper's value the memory adds little to the gradient.",
      large: "I(e) falls by 18 to 28 %, and the estimates end nearer to the truth.",
    },
    gamma: {
      what:
        "How strongly each new prediction error enters the memory w and the matrix Z. Only its product with β counts, so that " +
        "a change of γ does exactly what the same change of β does.",
      small: "I(e) rises by 2 to 6 %: at the paper's value the memory adds little to the gradient.",
      large: "I(e) falls by 18 to 28 %, and the estimates end nearer to the truth.",
    },
    forgetting: {
      what:
        "How fast the memory of prediction errors fades: the paper's value keeps the last 8 ms. A long memory is what replaces " +
        "persistent excitation, for as long as the true parameters do not change.",
      small:
        "With no forgetting at all most estimates find the truth within 12 s: 11 of 18 end within 10 % of it, where the paper's " +
        "value brings none there. I(e) falls by half.",
      large: "The memory is too short to matter: I(e) rises by 2 to 6 %, as it does without memory.",
    },
    filter_rad_s: {
      what: filter,
      small: "I(e) rises by at most 1.5 %: with the short memory of the paper's λ the filter has little to say.",
      large: "I(e) changes by less than 0.1 %.",
    },
    rho: {
      what:
        "Strength of the projection that turns an estimate back at its bounds. An estimate pushed below zero comes to rest " +
        "where ρ δ = 1, at a depth of the margin divided by ρ.",
      small: "At its least value, 1, tracking is the same to three digits: the estimates go a little further below zero.",
      large: "Tracking is the same to three digits. The estimates stay nearer to zero.",
    },
    gamma_adapt: {
      what: rate,
      small: "Learning is slow: after 12 s the estimates have hardly moved, and I(e) is 1.2 to 1.5 times as large.",
      large:
        "I(e) falls to about a half, but the estimates overshoot: some pass seven times the true value before they return. " +
        "The projection keeps them below ten times.",
    },
    lower_margin: {
      what:
        "Width of the strip below zero over which the projection grows to full strength. The physical parameters cannot be " +
        "negative, and the strip is how much the estimates may be.",
      small: "Tracking is the same to three digits; so narrow a strip is finer than one step of 1 ms resolves.",
      large: "Tracking is the same to three digits; estimates go down to −4·10⁻⁴.",
    },
    upper_factor: {
      what:
        "Upper bound of each estimate as a multiple of the nominal value: where the projection starts to push back. The " +
        "buttons move both bounds together, for this one must stay below the other.",
      small:
        "At a tenth of the nominal value the estimates cannot reach the truth; they stop at a tenth of it, and I(e) is 1.1 to " +
        "1.4 times as large.",
      large: "Nothing changes: with the paper's values no estimate passes 1.4 times the truth, so the bound is never met.",
    },
    upper_hard_factor: {
      what:
        "Where the upper margin ends and the projection has its full strength, as a multiple of the nominal value. The buttons " +
        "move both bounds together, for this one must stay above the other.",
      small:
        "At a tenth of the nominal value the estimates cannot reach the truth; they stop at a tenth of it, and I(e) is 1.1 to " +
        "1.4 times as large.",
      large: "Nothing changes: with the paper's values no estimate passes 1.4 times the truth, so the bound is never met.",
    },
  },
  tang_arteaga: {
    k_s: {
      what: feedback,
      small: "Joint 1 tracks 5 to 6 times worse, joint 2 2 to 3 times, joint 3 1.5 times. Some estimates swing far beyond the truth.",
      large: "All joints track 6 to 10 times better, and the estimates learn almost nothing: too little error is left to learn from.",
    },
    lambda: {
      what: slope,
      small: "The tracking errors grow about tenfold.",
      large: "The tracking errors shrink about tenfold, and the torque of joint 2 becomes rougher from sample to sample.",
    },
    delta: {
      what:
        "Weight of the remembered prediction error g in the adaptation. It multiplies g alone, without Γ_1, and only its " +
        "product with γ_2 counts.",
      small: "I(e) changes by less than 0.1 %: at the paper's value the memory has next to no part in the adaptation.",
      large: "I(e) changes by less than 1 %. It takes a thousand times the paper's value to matter, and then the torques peak at hundreds of N·m.",
    },
    gamma: {
      what:
        "How strongly each new prediction error enters the memory g and the matrix Z. Only its product with δ counts, so that a " +
        "change of γ_2 does exactly what the same change of δ does.",
      small: "I(e) changes by less than 0.1 %: at the paper's value the memory has next to no part in the adaptation.",
      large: "I(e) changes by less than 1 %. It takes a thousand times the paper's value to matter, and then the torques peak at hundreds of N·m.",
    },
    forgetting: {
      what:
        "How fast the memory of prediction errors fades: the paper's value keeps about the last 50 ms. Z, and with it the pull " +
        "towards the truth, grows as this is made smaller.",
      small: "Even with no forgetting I(e) falls by only 5 %: the weight δ γ_2 is too small for the memory to teach much in 12 s.",
      large: "I(e) changes by less than 0.1 %.",
    },
    filter_rad_s: {
      what: filter,
      small: "I(e) changes by less than 0.1 %: the memory, which alone uses the filter, has next to no part in the adaptation.",
      large: "I(e) changes by less than 0.1 %.",
    },
    gamma_adapt: {
      what: rate,
      small: "Joint 1 hardly notices; I(e) of joint 2 rises by a fifth, that of joint 3 by a half.",
      large:
        "I(e) falls by a tenth in joint 1 and by about a half in joints 2 and 3. This scheme has no projection: some estimates " +
        "swing to −8 and to 76 times the truth.",
    },
  },
  slotine_li: {
    k_s: {
      what: feedback,
      small: "All joints track 3 to 4 times worse, but the larger errors teach more: the estimates end nearer to the truth.",
      large:
        "All joints track 6 to 9 times better, and the estimates learn almost nothing. At a hundred times the paper's value a " +
        "step of 1 ms is too coarse and the run diverges; with 0.1 ms it does not.",
    },
    lambda: {
      what: slope,
      small: "The tracking errors grow 4 to 6 times.",
      large: "The tracking errors shrink 9 to 10 times, and the torque peaks rise by a tenth to a quarter.",
    },
    gamma_adapt: {
      what: rate,
      small: "Joint 1 tracks a tenth worse, joint 2 a fifth, joint 3 a half.",
      large: "I(e) falls to about a half. This scheme has no projection: an estimate goes as low as −1.3.",
    },
  },
};
