// How two documents differ: as a list to show, and as a patch that leads from one to the other.
//
// A patch is a list of `[pointer, value]` (set) and `[pointer]` (remove). Patches come from outside too, in links: they
// touch only what is a document's own.

const isObject = (value) => value !== null && typeof value === "object" && !Array.isArray(value);
const escaped = (part) => part.replaceAll("~", "~0").replaceAll("/", "~1");
const unescaped = (part) => part.replaceAll("~1", "/").replaceAll("~0", "~");

/** `[{pointer, before, after}]`, deepest values first to differ; undefined stands for what is not there. */
export function differences(before, after, pointer = "") {
  if (before === after) {
    return [];
  }
  if (isObject(before) && isObject(after)) {
    const keys = new Set([...Object.keys(before), ...Object.keys(after)]);
    return [...keys].flatMap((key) => differences(before[key], after[key], `${pointer}/${escaped(key)}`));
  }
  if (Array.isArray(before) && Array.isArray(after) && before.length === after.length) {
    return before.flatMap((value, n) => differences(value, after[n], `${pointer}/${n}`));
  }
  return JSON.stringify(before) === JSON.stringify(after) ? [] : [{ pointer, before, after }];
}

/** The patch that leads from `before` to `after`. */
export function patchBetween(before, after) {
  return differences(before, after).map(({ pointer, after: value }) => (value === undefined ? [pointer] : [pointer, value]));
}

/** A copy of `base` with a patch applied. Throws on a pointer whose parent is not there. */
export function patched(base, patch) {
  const copy = structuredClone(base);
  for (const [pointer, ...values] of patch) {
    const path = pointer.split("/").slice(1).map(unescaped);
    const last = path.pop();
    let node = copy;
    for (const part of path) {
      node = own(node, part) ? node[part] : undefined;
    }
    const settable = Array.isArray(node) ? own(node, last) && last !== "length" : isObject(node);
    if (last === undefined || last === "__proto__" || !settable) {
      throw new Error(`there is no ${pointer}`);
    }
    if (values.length > 0) {
      node[last] = structuredClone(values[0]);
    } else if (Array.isArray(node)) {
      throw new Error(`${pointer} cannot be removed`);
    } else {
      delete node[last];
    }
  }
  return copy;
}

function own(node, part) {
  return node !== null && typeof node === "object" && Object.hasOwn(node, part);
}
