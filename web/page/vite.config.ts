// SPDX-License-Identifier: MIT
// Builds the page into build/playground. The built files work from any folder of a plain server.
import { createHash } from 'node:crypto';
import { readdirSync, readFileSync, statSync, writeFileSync } from 'node:fs';
import { join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';
import { defineConfig, type Plugin } from 'vite';

const folder = (path: string) => fileURLToPath(new URL(path, import.meta.url));
const out = folder('../../build/playground');

function filesBelow(parent: string): string[] {
  return readdirSync(parent).flatMap((name) => {
    const path = join(parent, name);
    return statSync(path).isDirectory() ? filesBelow(path) : [path];
  });
}

/** Writes sw.js, the service worker, with the list of files to store for use without a network. */
function serviceWorker(): Plugin {
  return {
    name: 'service-worker',
    closeBundle() {
      const paths = filesBelow(out)
        .map((path) => relative(out, path))
        .filter((path) => path !== 'sw.js')
        // Meshes and pictures of samples are stored when a sample is opened.
        .filter((path) => !path.startsWith('gallery/') || /\.lsys$|list\.json$|picture\.png$/.test(path))
        .sort();
      const hash = createHash('sha256');
      for (const path of paths) hash.update(path).update(readFileSync(join(out, path)));
      const list = ['./', ...paths.filter((path) => path !== 'index.html')];
      const text = readFileSync(folder('./src/service_worker.js'), 'utf8')
        .replace("'VERSION'", JSON.stringify(hash.digest('hex').slice(0, 16)))
        .replace('[/* FILES */]', JSON.stringify(list));
      writeFileSync(join(out, 'sw.js'), text);
    },
  };
}

/** Lets the browser load the library together with the script, not after it. */
function preload(): Plugin {
  return {
    name: 'preload',
    transformIndexHtml: {
      order: 'post',
      handler: (_html, { bundle }) =>
        Object.keys(bundle ?? {})
          .filter((name) => name.endsWith('.wasm'))
          .map((name) => ({
            tag: 'link',
            attrs: { rel: 'preload', as: 'fetch', href: `./${name}`, crossorigin: true },
            injectTo: 'head',
          })),
    },
  };
}

export default defineConfig({
  root: folder('.'),
  base: './',
  build: {
    outDir: out,
    emptyOutDir: true,
    target: 'es2022',
    assetsInlineLimit: 0, // data: addresses are not in the Content-Security-Policy
    modulePreload: { polyfill: false },
    chunkSizeWarningLimit: 1000,
  },
  worker: { format: 'es' },
  plugins: [preload(), serviceWorker()],
});
