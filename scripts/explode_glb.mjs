// Moves the nodes of a .glb file away from their common centre, so that the fragments in it can be
// seen one by one:  node scripts/explode_glb.mjs IN.glb OUT.glb [FACTOR]
import {readFileSync, writeFileSync} from 'node:fs';

const [source, destination, factor = '0.35'] = process.argv.slice(2);
if (!destination) {
  console.error('usage: node explode_glb.mjs IN.glb OUT.glb [FACTOR]');
  process.exit(2);
}

const file = readFileSync(source);
const HEADER = 12;
const CHUNK_HEADER = 8;
const jsonLength = file.readUInt32LE(HEADER);
const jsonStart = HEADER + CHUNK_HEADER;
const gltf = JSON.parse(file.subarray(jsonStart, jsonStart + jsonLength).toString('utf8'));
const rest = file.subarray(jsonStart + jsonLength);

function boundsOf(nodes) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (const node of nodes) {
    for (const primitive of gltf.meshes[node.mesh].primitives) {
      const {min, max} = gltf.accessors[primitive.attributes.POSITION];
      for (let k = 0; k < 3; ++k) {
        low[k] = Math.min(low[k], min[k]);
        high[k] = Math.max(high[k], max[k]);
      }
    }
  }
  return {low, high};
}

const middle = ({low, high}) => low.map((value, k) => (value + high[k]) / 2);

const nodes = gltf.nodes.filter((node) => node.mesh !== undefined);
const center = middle(boundsOf(nodes));
for (const node of nodes) {
  const own = middle(boundsOf([node]));
  node.translation = own.map((value, k) => Number(factor) * (value - center[k]));
}

let json = Buffer.from(JSON.stringify(gltf));
json = Buffer.concat([json, Buffer.alloc((4 - (json.length % 4)) % 4, ' ')]);
const header = Buffer.from(file.subarray(0, jsonStart));
header.writeUInt32LE(jsonStart + json.length + rest.length, 8);
header.writeUInt32LE(json.length, HEADER);
writeFileSync(destination, Buffer.concat([header, json, rest]));
