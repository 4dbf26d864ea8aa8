// Reads an MCAP file of plumb-export with the formats' own readers and prints one line of JSON per
// message: the topic, the time [ns] and what the test compares. Ends with an error when the file, a
// schema or a message is not as the format or Foxglove's own schemas want it.
import { readFileSync } from 'node:fs';
import { McapIndexedReader, McapStreamReader } from '@mcap/core';
import * as known from '@foxglove/schemas/jsonschema.js';
import { parse } from '@foxglove/rosmsg';
import { MessageReader } from '@foxglove/rosmsg2-serialization';
import Ajv from 'ajv/dist/2020.js';

const bytes = readFileSync(process.argv[2]);

// From front to back, with every checksum.
const stream = new McapStreamReader({ validateCrcs: true });
stream.append(bytes);
let numStreamed = 0;
for (let record; (record = stream.nextRecord());) if (record.type === 'Message') ++numStreamed;
if (!stream.done()) throw new Error('the stream reader did not reach the end');

// By the index.
const reader = await McapIndexedReader.Initialize({
  readable: {
    size: async () => BigInt(bytes.length),
    read: async (offset, size) => new Uint8Array(bytes.subarray(Number(offset), Number(offset + size))),
  },
});
if (Number(reader.statistics.messageCount) !== numStreamed) throw new Error('the statistics miscount');
if (reader.chunkIndexes.length === 0) throw new Error('the file has no chunk index');

const ajv = new Ajv({ strict: false });
const decoders = new Map();
for (const channel of reader.channelsById.values()) {
  const schema = reader.schemasById.get(channel.schemaId);
  const text = new TextDecoder().decode(schema.data);
  if (channel.messageEncoding === 'cdr') {
    const cdr = new MessageReader(parse(text, { ros2: true }));
    decoders.set(channel.id, (data) => cdr.readMessage(data));
    continue;
  }
  const checks = [ajv.compile(JSON.parse(text))];
  if (schema.name.startsWith('foxglove.')) checks.push(ajv.compile(known[schema.name.slice(9)]));
  decoders.set(channel.id, (data) => {
    const message = JSON.parse(new TextDecoder().decode(data));
    for (const check of checks) if (!check(message)) throw new Error(channel.topic + ': ' + ajv.errorsText(check.errors));
    return message;
  });
}

const plain = (key, value) => {
  if (typeof value === 'bigint') return Number(value);
  if (ArrayBuffer.isView(value)) return value instanceof Uint8Array ? { numBytes: value.length } : Array.from(value);
  return key === 'data' && typeof value === 'string' ? { numBytes: Buffer.from(value, 'base64').length } : value;
};
let numIndexed = 0;
for await (const message of reader.readMessages()) {
  ++numIndexed;
  const { topic } = reader.channelsById.get(message.channelId);
  const line = { topic, time_ns: message.logTime.toString(), message: decoders.get(message.channelId)(message.data) };
  console.log(JSON.stringify(line, plain));
}
if (numIndexed !== numStreamed) throw new Error(`${numIndexed} messages by the index, ${numStreamed} in the file`);
