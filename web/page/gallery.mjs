// SPDX-License-Identifier: MIT
// Copies the samples of the gallery with their pictures and files into public/gallery, and writes
// list.json. Usage: node gallery.mjs
import { cpSync, existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const samples = join(here, '../../samples');
const target = join(here, 'public/gallery');

// Group, then samples with title and a sentence about them.
const groups = {
  'First steps': {
    'abop-1-24c': ['Weed', 'One rule, five generations'],
    'teach-param': ['Forks with sliders', 'Parameters of the angle and length'],
    'teach-random-range': ['Chance', 'Random angles: every seed is another plant'],
    'abop-1-25-bush': ['Bush with leaves', 'Leaves as polygons'],
    'teach-let': ['Vigour of shoots', 'Strong shoots are long and thick'],
    'teach-gradient': ['Red-hot poker', 'Size and colour depend on the height'],
  },
  Plants: {
    'plant-fern': ['Fern', 'Fronds that unroll'],
    'plant-foxglove': ['Foxglove', 'A spike of bells'],
    'plant-palm': ['Palm', 'A crown of feathers'],
    'abop-sunflower': ['Sunflower head', 'Florets at 137.5 degrees'],
    'abop-lychnis': ['Lychnis', 'Flowers in the order of their ages'],
    'abop-mycelis': ['Lettuce', 'A signal that makes buds flower'],
    'abop-3-2-crocus': ['Crocus', 'Leaves, stalk and flower'],
    'abop-5-12-rose-leaf': ['Rose leaf', 'An outline that grows'],
    'teach-curve': ['Fir', 'Boughs follow curves'],
    'teach-poisson': ['Cherry blossom', 'Clusters of chance'],
    'carey-type-0': ['Branching tree', 'Six rules for buds and wood'],
    'abop-2-8b': ['Tree in the wind', 'Branches bend with a tropism'],
  },
  'Species in metres': {
    'species/silver-birch': ['Silver birch', 'With seasons and age'],
    'species/pedunculate-oak': ['Pedunculate oak', 'With seasons and age'],
    'species/norway-spruce': ['Norway spruce', 'Whorls of boughs'],
    'species/scots-pine': ['Scots pine', 'A bare trunk and a flat crown'],
    'species/weeping-willow': ['Weeping willow', 'Hanging twigs'],
    'species/coconut-palm': ['Coconut palm', 'A ringed trunk'],
    'species/male-fern': ['Male fern', 'A shuttlecock of fronds'],
    'species/saguaro': ['Saguaro', 'Ribs and arms'],
    'species/rose-bush': ['Rose bush', 'Shoots and flowers'],
    'species/dandelion': ['Dandelion', 'From bud to clock'],
  },
  'Plants that sense': {
    'competing-tips': ['Branch tips that compete', 'A tip with a neighbour rests'],
    'two-trees': ['Two trees', 'Their crowns shade each other'],
    topiary: ['Topiary', 'Clipped by a mesh'],
  },
  Curves: {
    'abop-1-10a-dragon': ['Dragon curve', 'Two rules of turns'],
    'abop-1-11a-gosper': ['Gosper curve', 'Hexagons filled by one line'],
    'abop-1-19-hilbert-space': ['Hilbert curve in space', 'A line that fills a cube'],
    'crankshaw-2-3-koch': ['Koch curve', 'The classic snowflake edge'],
    'abop-1-10b-sierpinski': ['Sierpinski arrowhead', 'A triangle from one line'],
    'abop-1-6-koch-island': ['Koch island', 'A coast of right angles'],
  },
};

/** Files that a grammar names, and files that those name in turn. */
function filesOf(folder, path, found = new Set()) {
  const text = readFileSync(join(folder, path), 'latin1');
  const names = /\.mtl$/.test(path)
    ? [...text.matchAll(/^\s*(?:map_\w+|norm|bump)\s+(?:-\S+\s+\S+\s+)*(\S+)\s*$/gm)]
    : /\.obj$/.test(path)
      ? [...text.matchAll(/^\s*mtllib\s+(\S+)\s*$/gm)]
      : /\.lsys$/.test(path)
        ? [...text.matchAll(/"([^"\n]+\.(?:obj|png|jpg|lsys))"/g)]
        : [];
  for (const [, name] of names) {
    if (found.has(name) || !existsSync(join(folder, name))) continue;
    found.add(name);
    filesOf(folder, name, found);
  }
  return found;
}

rmSync(target, { recursive: true, force: true });
const list = [];
for (const [group, entries] of Object.entries(groups)) {
  for (const [path, [title, about]] of Object.entries(entries)) {
    const id = path.split('/').at(-1);
    const folder = join(samples, path);
    const files = [...filesOf(folder, `${id}.lsys`)].sort();
    mkdirSync(join(target, id), { recursive: true });
    cpSync(join(folder, `${id}.png`), join(target, id, 'picture.png'));
    for (const file of [`${id}.lsys`, ...files]) cpSync(join(folder, file), join(target, id, file));
    list.push({ id, title, about, group, files });
  }
}
writeFileSync(join(target, 'list.json'), JSON.stringify(list));
console.log(`gallery: ${list.length} samples`);
