// SPDX-License-Identifier: MIT
// Bundles the extension, the page of the preview, and the modules that the tests load, into dist/. Writes the licences
// of the bundled packages to NOTICES.txt.
import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { build } from 'esbuild';

const common = {
  bundle: true,
  minify: true,
  legalComments: 'none',
  logLevel: 'warning',
  metafile: true,
};

const results = await Promise.all([
  build({
    ...common,
    entryPoints: ['src/extension.ts'],
    outfile: 'dist/extension.js',
    platform: 'node',
    target: 'node18',
    format: 'cjs',
    external: ['vscode'],
  }),
  build({
    ...common,
    entryPoints: ['webview/preview.ts'],
    outfile: 'dist/preview.js',
    platform: 'browser',
    target: 'chrome114',
    format: 'iife',
    loader: { '.css': 'text' },
  }),
  build({
    ...common,
    minify: false,
    entryPoints: ['src/find_program.ts', 'src/plant_session.ts', 'src/preview_page.ts', 'src/sources.ts'],
    outdir: 'dist/modules',
    platform: 'node',
    target: 'node18',
    format: 'esm',
    outExtension: { '.js': '.mjs' },
  }),
]);

const folders = new Set();
for (const { metafile } of results) {
  for (const input of Object.keys(metafile.inputs)) {
    const found = /^(.*node_modules\/(?:@[^/]+\/)?[^/]+)\//.exec(input);
    if (found !== null) {
      folders.add(found[1]);
    }
  }
}
const notices = [...folders].sort().map((folder) => {
  const { name, version, license } = JSON.parse(readFileSync(`${folder}/package.json`, 'utf8'));
  const file = readdirSync(folder).find((each) => /^licen[cs]e/i.test(each));
  if (file === undefined) {
    throw new Error(`${folder} has no licence`);
  }
  const text = readFileSync(`${folder}/${file}`, 'utf8').trim();
  return `${name} ${version}: ${license}\n\n${text}\n`;
});
writeFileSync(
  'NOTICES.txt',
  `The extension contains these packages.\n\n${notices.join(`\n${'-'.repeat(80)}\n\n`)}`,
);
