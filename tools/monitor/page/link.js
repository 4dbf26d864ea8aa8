// The WebSocket to plumb-monitor: parses packets, acknowledges them, connects again.

export const PROTOCOL = 'plumb-monitor';
const RETRY_MS = 1500;

/** Splits a packet (u32 length of the JSON, JSON, JPEG) into { message, jpeg }. */
export function parsePacket(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const text = new TextDecoder().decode(new Uint8Array(buffer, 4, length));
  const jpeg = buffer.byteLength > 4 + length ? new Uint8Array(buffer, 4 + length) : null;
  return { message: JSON.parse(text), jpeg };
}

export class Link {
  /** onPacket(message, jpeg, buffer); onState(connected). */
  constructor(onPacket, onState) {
    this.onPacket = onPacket;
    this.onState = onState;
    this.open();
  }

  open() {
    this.socket = new WebSocket(`ws://${location.host}/`, PROTOCOL);
    this.socket.binaryType = 'arraybuffer';
    this.socket.onopen = () => this.onState(true);
    this.socket.onmessage = (event) => {
      const { message, jpeg } = parsePacket(event.data);
      this.onPacket(message, jpeg, event.data);
    };
    this.socket.onclose = () => {
      this.onState(false);
      setTimeout(() => this.open(), RETRY_MS);
    };
  }

  send(text) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(text);
  }

  acknowledge(id) {
    this.send(`ack ${id}`);
  }

  requestFrame(index) {
    this.send(`frame ${index}`);
  }
}
