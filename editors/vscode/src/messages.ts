// SPDX-License-Identifier: MIT
// The messages between the extension and the page of the preview.

import type { Parameter, Plant } from './protocol';

/** Values that the user has set in the preview; unset values are those of the grammar. */
export interface PreviewOptions {
  generations?: number;
  seed?: number;
  definitions: Record<string, number>;
}

/** The numbers of a plant. */
export type PlantInfo = Omit<Plant, 'glb' | 'sources'>;

export type ToPage =
  | {
      type: 'plant';
      /** A GLB file; empty if the plant draws nothing. */
      glb: ArrayBuffer;
      info: PlantInfo;
      parameters: Parameter[];
      lastGeneration: number | null;
      options: PreviewOptions;
      title: string;
    }
  | {
      /** The last plant stays. */
      type: 'problem';
      message: string;
      parameters: Parameter[];
      lastGeneration: number | null;
      options: PreviewOptions;
      title: string;
    }
  | { type: 'busy' }
  /** Numbers of sources whose parts of the plant are highlighted. */
  | { type: 'highlight'; sources: number[] };

export type FromPage =
  | { type: 'ready' }
  | { type: 'options'; options: PreviewOptions }
  /** A click on the part of a source; exact: on the module only, else on its statement. */
  | { type: 'pick'; source: number; exact: boolean }
  | { type: 'failure'; message: string };
