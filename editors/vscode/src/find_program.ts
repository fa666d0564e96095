// SPDX-License-Identifier: MIT
// Finds the program lsc, as the setting `lsys.path` names it.

import { accessSync, constants, statSync } from 'node:fs';
import * as path from 'node:path';

/** The values of the environment that the search uses. */
export interface Surroundings {
  home: string;
  /** The first folder of the workspace. */
  folder: string | undefined;
  /** The value of PATH. */
  searched: string;
  windows: boolean;
}

export type Found = { program: string } | { problem: string };

function isProgram(file: string): boolean {
  try {
    accessSync(file, constants.X_OK);
    return statSync(file).isFile();
  } catch {
    return false;
  }
}

/** The absolute path of the program, or a sentence that says where it was searched. */
export function findProgram(setting: string, around: Surroundings): Found {
  const named = setting.trim() || 'lsc';
  const endings = around.windows ? ['', '.exe'] : [''];
  if (!/[/\\]/.test(named)) {
    const folders = around.searched.split(around.windows ? ';' : ':').filter((each) => each !== '');
    for (const folder of folders) {
      for (const ending of endings) {
        const file = path.join(folder, named + ending);
        if (isProgram(file)) {
          return { program: file };
        }
      }
    }
    return { problem: `The program \`${named}\` is in no folder of PATH.` };
  }
  const expanded = named
    .replace(/^~(?=[/\\])/, () => around.home)
    .replace(/\$\{workspaceFolder\}/g, () => around.folder ?? '');
  const file = path.resolve(around.folder ?? around.home, expanded);
  for (const ending of endings) {
    if (isProgram(file + ending)) {
      return { program: file + ending };
    }
  }
  return { problem: `\`${file}\` does not exist or is no program.` };
}
