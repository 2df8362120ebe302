// Server-sent events read from a response's body: EventSource cannot carry a token.

/** Calls `onEvent({id, type, data})` for each event of the body, and `onSign` for each sign of life, until it ends. */
export async function readEvents(body, onEvent, onSign = () => {}) {
  const reader = body.pipeThrough(new TextDecoderStream()).getReader();
  let text = "";
  for (;;) {
    const { done, value } = await reader.read();
    if (done) {
      return;
    }
    onSign();
    text += value;
    // What follows the last blank line is not whole yet.
    const blocks = text.replaceAll("\r\n", "\n").split("\n\n");
    text = blocks.pop();
    for (const event of blocks.map(parseEvent)) {
      if (event.data !== null) {
        onEvent(event);
      }
    }
  }
}

/** One event from its lines; `data` is null where there is none, as in a comment. */
export function parseEvent(block) {
  const event = { id: null, type: "message", data: null };
  for (const line of block.split("\n")) {
    const [, field, value] = /^([^:]*):? ?(.*)$/u.exec(line);
    if (field === "id") {
      event.id = value;
    } else if (field === "event") {
      event.type = value;
    } else if (field === "data") {
      event.data = event.data === null ? value : `${event.data}\n${value}`;
    }
  }
  return event;
}
