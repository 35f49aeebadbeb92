// What glTF files hide and what their variants are, as glTF-Transform reads them.
//
//   node alternatives.mjs FILE...
//
// One line of JSON a file: `hidden`, the names of the nodes with meshes that are not shown, sorted;
// `variants`, the names of all; and `colors`, for each named node with variants its base colour in each
// of them, by name.

import { NodeIO } from '@gltf-transform/core';
import { ALL_EXTENSIONS } from '@gltf-transform/extensions';
import { MeshoptDecoder } from 'meshoptimizer';

await MeshoptDecoder.ready;
const io = new NodeIO()
  .registerExtensions(ALL_EXTENSIONS)
  .registerDependencies({ 'meshopt.decoder': MeshoptDecoder });

function isHidden(node) {
  for (let at = node; at; at = at.getParentNode()) {
    if (at.getExtension('KHR_node_visibility')?.getVisible() === false) return true;
  }
  return false;
}

function colorsOf(node) {
  const mappings = node.getMesh().listPrimitives()[0].getExtension('KHR_materials_variants');
  const colors = {};
  for (const mapping of mappings?.listMappings() ?? []) {
    const color = mapping.getMaterial().getBaseColorFactor().slice(0, 3).map((v) => Math.round(v));
    for (const variant of mapping.listVariants()) colors[variant.getName()] = color;
  }
  return colors;
}

for (const file of process.argv.slice(2)) {
  const root = (await io.read(file)).getRoot();
  const meshes = root.listNodes().filter((node) => node.getMesh());
  const hidden = meshes.filter(isHidden).map((node) => node.getName()).sort();
  const extension = root.listExtensionsUsed().find((e) => e.extensionName === 'KHR_materials_variants');
  const variants = (extension?.listProperties() ?? [])
    .filter((property) => property.propertyType === 'Variant')
    .map((variant) => variant.getName());
  const named = meshes.filter((node) => node.getName() !== '');
  const colored = named.map((node) => [node.getName(), colorsOf(node)]);
  const colors = Object.fromEntries(colored.filter(([, all]) => Object.keys(all).length > 0));
  console.log(JSON.stringify({ hidden, variants, colors }));
}
