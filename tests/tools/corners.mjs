// Corners of all meshes of glTF files, decoded by glTF-Transform, which shares no code with Ivory.
//
//   node corners.mjs --list NAMES.txt
//
// Beside each file it leaves FILE.corners: x, y, z in the world as little-endian f64 for each index
// of each primitive, copies (EXT_mesh_gpu_instancing) among them. One line a file on standard
// output: an error in words, or nothing.

import { readFile, writeFile } from 'node:fs/promises';

import { NodeIO } from '@gltf-transform/core';
import { ALL_EXTENSIONS } from '@gltf-transform/extensions';
import { MeshoptDecoder } from 'meshoptimizer';

await MeshoptDecoder.ready;
const io = new NodeIO()
  .registerExtensions(ALL_EXTENSIONS)
  .registerDependencies({ 'meshopt.decoder': MeshoptDecoder });

function transformed([x, y, z], m) {
  return [0, 1, 2].map((k) => m[k] * x + m[4 + k] * y + m[8 + k] * z + m[12 + k]);
}

/** A matrix of translation, rotation and scale, by columns. */
function matrixOf([tx, ty, tz], [x, y, z, w], [sx, sy, sz]) {
  return [
    (1 - 2 * (y * y + z * z)) * sx, 2 * (x * y + z * w) * sx, 2 * (x * z - y * w) * sx, 0,
    2 * (x * y - z * w) * sy, (1 - 2 * (x * x + z * z)) * sy, 2 * (y * z + x * w) * sy, 0,
    2 * (x * z + y * w) * sz, 2 * (y * z - x * w) * sz, (1 - 2 * (x * x + y * y)) * sz, 0,
    tx, ty, tz, 1,
  ];
}

function copiesOf(node) {
  const copies = node.getExtension('EXT_mesh_gpu_instancing');
  if (!copies) return [matrixOf([0, 0, 0], [0, 0, 0, 1], [1, 1, 1])];
  const attribute = (name) => copies.getAttribute(name);
  const [places, turns, scales] = ['TRANSLATION', 'ROTATION', 'SCALE'].map(attribute);
  const at = (accessor, i, otherwise) => (accessor ? accessor.getElement(i, []) : otherwise);
  return Array.from({ length: places.getCount() }, (_, i) =>
    matrixOf(at(places, i), at(turns, i, [0, 0, 0, 1]), at(scales, i, [1, 1, 1])),
  );
}

async function cornersOf(file) {
  const document = await io.read(file);
  const numbers = [];
  for (const node of document.getRoot().listNodes()) {
    const world = node.getWorldMatrix();
    const copies = node.getMesh() ? copiesOf(node) : [];
    for (const primitive of node.getMesh()?.listPrimitives() ?? []) {
      const positions = primitive.getAttribute('POSITION');
      const indices = primitive.getIndices();
      const count = (indices ?? positions).getCount();
      for (const copy of copies) {
        for (let i = 0; i < count; i += 1) {
          const element = positions.getElement(indices ? indices.getScalar(i) : i, []);
          numbers.push(...transformed(transformed(element, copy), world));
        }
      }
    }
  }
  return new Float64Array(numbers);
}

const [, , , list] = process.argv;
const files = (await readFile(list, 'utf8')).split('\n').filter((name) => name !== '');
for (const file of files) {
  try {
    await writeFile(`${file}.corners`, await cornersOf(file));
    console.log('');
  } catch (error) {
    console.log(String(error).replaceAll('\n', ' ') || 'an error without words');
  }
}
