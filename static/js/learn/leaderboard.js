// The leaderboard, where the teacher switched it on: points without names, one's own place marked.

import { client } from "../classroom/client.js";
import { card, points, showError, table } from "../classroom/parts.js";
import { element } from "../dom.js";
import { texts } from "../strings/classroom.js";

const own = texts.leaderboard;
const SHOWN = 10;

/** A card with `refresh()`, or null where there is none for this assignment. */
export function leaderboardCard({ id, leaderboard }) {
  if (!leaderboard) {
    return null;
  }
  const place = element("div", {});
  const node = card(own.title, element("p", { class: "help" }, own.help), place);
  node.classList.add("leaderboard");
  async function refresh() {
    try {
      const { entries } = await client.get(`assignments/${id}/leaderboard`);
      place.replaceChildren(entries.length > 0 ? leaderboardTable(entries) : element("p", { class: "help" }, own.empty));
    } catch (error) {
      showError(place, error, refresh);
    }
  }
  refresh();
  return { node, refresh };
}

/** The best, and oneself wherever one is. */
export function leaderboardTable(entries) {
  const shown = entries.filter(({ you }, n) => n < SHOWN || you);
  // To a teacher none of them is "you".
  const isThere = shown.some(({ you }) => you);
  const rows = shown.map(({ rank, points: own_points, you }) => ({
    "aria-current": you ? "true" : null,
    cells: [String(rank), points(own_points), ...(isThere ? [you ? own.you : ""] : [])],
  }));
  return table({ caption: own.caption(entries.length), heads: [own.rank, own.points, ...(isThere ? [own.who] : [])], rows, className: "board-table" });
}
