// Equations as native MathML, from a short notation that reads like the equation.
//
// One letter is one identifier; `x_i`, `x_{i j}`, `x^T` are scripts; `hat(x)`, `dot(x)`, `ddot(x)`, `tilde(x)` put a mark
// above; `frac(a; b)`, `sqrt(a)`, `abs(a)`, `norm(a)` are what they say; known words such as `sign` stand upright.

const NAMESPACE = "http://www.w3.org/1998/Math/MathML";
const ACCENTS = { hat: "^", dot: "˙", ddot: "¨", tilde: "~" };
const FENCES = { abs: "|", norm: "‖" };
const WORDS = ["sign", "tanh", "diag", "sin", "cos"];
const TOKEN = /\s+|[a-zA-Z]{2,}(?=\()|(?:sign|tanh|diag|sin|cos)(?![a-zA-Z])|\d+(?:\.\d+)?|./gu;

/** The equation as a `<math>` element; `display` sets it as one that stands alone. */
export function math(text, display = false) {
  const tokens = text.match(TOKEN).filter((token) => token.trim() !== "");
  const node = mathElement("math", row(tokens, []));
  if (display) {
    node.setAttribute("displaystyle", "true");
  }
  return node;
}

function mathElement(tag, ...children) {
  const node = document.createElementNS(NAMESPACE, tag);
  node.append(...children.flat());
  return node;
}

/** Reads items up to one of `ends`, which is taken too. */
function row(tokens, ends) {
  const items = [];
  while (tokens.length > 0) {
    if (ends.includes(tokens[0])) {
      tokens.shift();
      break;
    }
    items.push(scripted(tokens));
  }
  return items;
}

function scripted(tokens) {
  const base = item(tokens);
  const below = tokens[0] === "_" ? script(tokens) : null;
  const above = tokens[0] === "^" ? script(tokens) : null;
  if (below && above) {
    return mathElement("msubsup", base, below, above);
  }
  return below ? mathElement("msub", base, below) : above ? mathElement("msup", base, above) : base;
}

function script(tokens) {
  tokens.shift();
  return item(tokens);
}

function item(tokens) {
  const token = tokens.shift();
  if (token === "{") {
    return mathElement("mrow", row(tokens, ["}"]));
  }
  if (tokens[0] === "(" && !WORDS.includes(token) && /^[a-z]{2,}$/u.test(token)) {
    tokens.shift();
    return applied(token, tokens);
  }
  if (/^\d/u.test(token)) {
    return mathElement("mn", token);
  }
  if (/^\p{L}/u.test(token)) {
    // Not the mathematical letters of Unicode, which many systems have no font for: explain.css slants these.
    const identifier = mathElement("mi", token);
    identifier.setAttribute("mathvariant", "normal");
    identifier.classList.toggle("upright", token.length > 1 || /^[Α-Ω]/u.test(token));
    return identifier;
  }
  return operator(token);
}

/** An operator at its own size: nothing here is so high that parentheses had to grow with it. */
function operator(text) {
  const node = mathElement("mo", text);
  node.setAttribute("stretchy", "false");
  return node;
}

/** What stands in the parentheses after a name, which are open. */
function applied(name, tokens) {
  if (name === "frac") {
    return mathElement("mfrac", mathElement("mrow", row(tokens, [";"])), mathElement("mrow", row(tokens, [")"])));
  }
  const inner = row(tokens, [")"]);
  if (name === "sqrt") {
    return mathElement("msqrt", inner);
  }
  if (name in FENCES) {
    return mathElement("mrow", operator(FENCES[name]), inner, operator(FENCES[name]));
  }
  const over = mathElement("mover", mathElement("mrow", inner), operator(ACCENTS[name]));
  over.setAttribute("accent", "true");
  return over;
}
