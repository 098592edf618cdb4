// Writes the mesh of the npm package `bunny` as an OBJ file, whole or not at all.
//   node scripts/make_bunny.mjs NODE_MODULES_DIR OUT.obj
import fs from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';

const [modules, out] = process.argv.slice(2);
if (!modules || !out) {
  console.error('usage: node scripts/make_bunny.mjs NODE_MODULES_DIR OUT.obj');
  process.exit(2);
}

const require = createRequire(path.resolve(modules, 'index.js'));
let bunny;
try {
  bunny = require(path.resolve(modules, 'bunny'));
} catch (error) {
  console.error(`make_bunny: no package 'bunny' in ${modules}: ${error.message}`);
  console.error('install it first: npm install --prefix third_party');
  process.exit(2);
}

const lines = ['# The Stanford bunny of the npm package bunny, public domain.'];
for (const [x, y, z] of bunny.positions) lines.push(`v ${x} ${y} ${z}`);
for (const [a, b, c] of bunny.cells) lines.push(`f ${a + 1} ${b + 1} ${c + 1}`);

const partial = `${out}.partial-${process.pid}`;
try {
  fs.mkdirSync(path.dirname(path.resolve(out)), { recursive: true });
  fs.writeFileSync(partial, lines.join('\n') + '\n');
  fs.renameSync(partial, out);
} catch (error) {
  fs.rmSync(partial, { force: true });
  console.error(`make_bunny: cannot write ${out}: ${error.message}`);
  process.exit(1);
}
console.log(`${out}: ${bunny.positions.length} vertices, ${bunny.cells.length} faces`);
