// Numbers of the pages that are not the playground, as the reader writes them: with a decimal comma where others stand beside.
// The playground keeps the point of its figures and fields.

import { formatNumber } from "../format.js";
import { locale } from "./times.js";

/** A number with `digits` significant digits and the reader's decimal sign. */
export function formatLocal(value, digits) {
  const { value: sign } = new Intl.NumberFormat(locale()).formatToParts(1.5).find(({ type }) => type === "decimal");
  return formatNumber(value, digits).replace(".", sign);
}
