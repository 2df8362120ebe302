// Texts: refusals of the core, in the reader's language.

const withUnit = (unit) => (unit ? ` ${unit}` : "");

export const errors = {
  // A field's name, for the start of a sentence.
  ofJoint: (name, joint) => `${name}, joint ${joint}`,
  ofParameter: (name, parameter) => `${name}, ${parameter}`,
  element: (name, number) => `${name}, number ${number}`,
  someValue: "The value",
  // What is wrong with it, by the core's kind of problem.
  outOfRange: (name, value, min, max, unit) => `${name} must be between ${min} and ${max}${withUnit(unit)}; ${value} is not`,
  notANumber: (name, text) => (text === "" ? `${name} must be a number` : `${name} must be a number; “${text}” is not`),
  wrongLength: (name, found, expected) => `${name} needs ${expected} numbers; there are ${found}`,
  tooMany: (name, found, most) => `${name} may have at most ${most} entries; there are ${found}`,
  otherRobot: (other, own) => `another robot than the playground's: “${other}” and not “${own}”`,
  unknown: (name, value, allowed) => `${name} cannot be “${value}”; allowed: ${allowed}`,
};
