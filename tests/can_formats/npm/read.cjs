// Prints what candied reads from a DBC as JSON. The first line that it does not know ends it.
const { readFileSync } = require('node:fs');
const { Dbc } = require('candied');

const dbc = new Dbc();
const data = dbc.load(readFileSync(process.argv[2], 'utf8'), true);
if (dbc.errors.size > 0) throw new Error(`lines ${[...dbc.errors.keys()]} are not understood`);
const plain = (map) => (map ? Object.fromEntries(map) : null);
console.log(JSON.stringify({
  version: data.version,
  messages: [...data.messages.values()].map((message) => ({
    name: message.name, id: message.id, dlc: message.dlc,
    signals: [...message.signals.values()].map(({ name, startBit, length, factor, offset, min, max, unit, signed, endian, multiplex, multiplexer, description, valueTable }) =>
      ({ name, startBit, length, factor, offset, min, max, unit, signed, endian, multiplex, multiplexer, description, values: plain(valueTable) })),
  })),
}));
