// Textos: lo que el núcleo rechaza.

const withUnit = (unit) => (unit ? ` ${unit}` : "");

export const errors = {
  ofJoint: (name, joint) => `${name}, articulación ${joint}`,
  ofParameter: (name, parameter) => `${name}, ${parameter}`,
  element: (name, number) => `${name}, número ${number}`,
  someValue: "El valor",
  outOfRange: (name, value, min, max, unit) => `${name} debe estar entre ${min} y ${max}${withUnit(unit)}; ${value} no lo está`,
  notANumber: (name, text) => (text === "" ? `${name} debe ser un número` : `${name} debe ser un número; «${text}» no lo es`),
  wrongLength: (name, found, expected) => `${name} necesita ${expected} números; hay ${found}`,
  tooMany: (name, found, most) => `${name} admite como máximo ${most} elementos; hay ${found}`,
  otherRobot: (other, own) => `otro robot que el del laboratorio: «${other}» y no «${own}»`,
  unknown: (name, value, allowed) => `${name} no puede ser «${value}»; se admite: ${allowed}`,
};
