// JSON pointers: reading and replacing one value in a document.

const parts = (pointer) => pointer.split("/").slice(1);

/** The value at `pointer`, or undefined. */
export function valueAt(document, pointer) {
  return parts(pointer).reduce((node, part) => node?.[part], document);
}

/** A copy of the document with `value` at `pointer`, whose parent exists. */
export function withValueAt(document, pointer, value) {
  const copy = structuredClone(document);
  const path = parts(pointer);
  const last = path.pop();
  path.reduce((node, part) => node[part], copy)[last] = value;
  return copy;
}
