// SPDX-License-Identifier: MIT
// Files to download.
import { zipSync } from 'fflate';
import type { NamedFile, PlantOptions } from 'lsys';
import type { Engine } from './engine.js';
import type { Stage } from './stage.js';

export interface DownloadContext {
  engine: Engine;
  stage: Stage;
  text: string;
  options: PlantOptions;
  /** Without extension. */
  name: string;
}

interface Format {
  extension: string;
  about: string;
  make(context: DownloadContext): Promise<{ name: string; blob: Blob }>;
}

const fileOf = (name: string, bytes: Uint8Array, type: string) => ({
  name,
  blob: new Blob([bytes as BlobPart], { type }),
});

/** One file, or a ZIP of several. */
function packed(name: string, files: NamedFile[], type: string): { name: string; blob: Blob } {
  if (files.length === 1) return fileOf(files[0]!.name, files[0]!.bytes, type);
  const entries = Object.fromEntries(files.map((file) => [file.name, file.bytes]));
  return fileOf(`${name}.zip`, zipSync(entries), 'application/zip');
}

/** A format that the library writes. `type`: its media type. */
function exported(extension: string, about: string, type: string): Format {
  return {
    extension,
    about,
    async make({ engine, text, options, name }) {
      const { files } = await engine.call('write', text, `${name}.${extension}`, options);
      return packed(name, files, type);
    },
  };
}

export const formats: Format[] = [
  exported('glb', '3D model with textures, for browsers, Blender and game engines', 'model/gltf-binary'),
  exported('obj', '3D model for nearly every program, with its materials as a ZIP', 'model/obj'),
  exported('svg', 'Drawing of the stems and leaves, for print', 'image/svg+xml'),
  {
    extension: 'png',
    about: 'Picture as it is shown here',
    make: async ({ stage, name }) => ({ name: `${name}.png`, blob: await stage.picture() }),
  },
  {
    extension: 'lsys',
    about: 'The grammar as text, for lsc and lsview',
    make: async ({ text, name }) => ({
      name: `${name}.lsys`,
      blob: new Blob([text], { type: 'text/plain' }),
    }),
  },
  {
    extension: 'lsb',
    about: 'The grammar compiled to bytecode',
    make: async ({ engine, text, options, name }) =>
      fileOf(
        `${name}.lsb`,
        await engine.call('bytecode', text, options),
        'application/octet-stream',
      ),
  },
];

export function save({ name, blob }: { name: string; blob: Blob }): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}
