// SPDX-License-Identifier: MIT
// PlantSession: the preview of one grammar without VS Code. Asks the server for plants, passes the
// newest to the page, and answers clicks and movements of the cursor.

import type { FromPage, PreviewOptions, ToPage } from './messages';
import {
  requestCancelled,
  serverCancelled,
  type PlantParams,
  type PlantResult,
  type Position,
  type Range,
  type Source,
} from './protocol';
import { sourcesAt } from './sources';

/** The settings `lsys.preview`: limits, and whether textures are drawn. */
export interface PreviewLimits {
  maxModules?: number;
  maxTriangles?: number;
  maxSeconds?: number;
  textures?: boolean;
}

/** The functions of the editor that a session calls. */
export interface SessionHost {
  /** Sends `lsys/plant`. */
  request(params: PlantParams): Promise<PlantResult>;
  /** Sends a message to the page. */
  post(message: ToPage): void;
  /** Selects a range in a text of the editor. */
  select(uri: string, range: Range): void;
  limits(): PreviewLimits;
}

export class PlantSession {
  private options: PreviewOptions = { definitions: {} };
  /** The sources of the shown plant, by number. */
  private sources: Source[] = [];
  /** The number of the last request. */
  private lastRequest = 0;
  /** The last plant or problem that was sent to the page. */
  private shown: ToPage | undefined;
  private cursor: { uri: string; position: Position } | undefined;

  constructor(
    readonly uri: string,
    private readonly title: string,
    private readonly host: SessionHost,
  ) {}

  /** Asks for the plant of the current text. Ends when it is shown, or a newer one was asked for. */
  async refresh(): Promise<void> {
    const number = ++this.lastRequest;
    this.host.post({ type: 'busy' });
    let result: PlantResult;
    try {
      result = await this.host.request({
        textDocument: { uri: this.uri },
        ...this.host.limits(),
        ...this.options,
      });
    } catch (error) {
      const code = (error as { code?: unknown }).code;
      if (number === this.lastRequest && code !== serverCancelled && code !== requestCancelled) {
        this.problem((error as Error).message, [], null);
      }
      return;
    }
    if (number !== this.lastRequest) {
      return;
    }
    if (result.plant === null) {
      this.problem(result.message ?? '', result.parameters, result.lastGeneration);
      return;
    }
    const { glb, sources, ...info } = result.plant;
    this.sources = sources;
    const bytes = Buffer.from(glb, 'base64');
    this.show({
      type: 'plant',
      glb: bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength) as ArrayBuffer,
      info,
      parameters: result.parameters,
      lastGeneration: result.lastGeneration,
      options: this.options,
      title: this.title,
    });
    this.highlight(); // the parts of the new plant that the statement at the cursor made
  }

  /** Handles a message of the page. */
  async receive(message: FromPage): Promise<void> {
    if (message.type === 'ready') {
      if (this.shown !== undefined) {
        this.host.post(this.shown);
      } else {
        await this.refresh();
      }
    } else if (message.type === 'options') {
      this.options = message.options;
      await this.refresh();
    } else if (message.type === 'pick') {
      this.reveal(message.source, message.exact);
    } else {
      this.problem(message.message, [], null);
    }
  }

  /** Highlights the parts that the module or production at a position drew. */
  moveCursor(uri: string, position: Position): void {
    this.cursor = { uri, position };
    this.highlight();
  }

  clearHighlight(): void {
    this.cursor = undefined;
    this.highlight();
  }

  private highlight(): void {
    const { uri, position } = this.cursor ?? {};
    const sources =
      uri !== undefined && position !== undefined ? sourcesAt(this.sources, uri, position) : [];
    this.host.post({ type: 'highlight', sources });
  }

  private reveal(number: number, exact: boolean): void {
    const source = this.sources[number];
    const range = exact ? source?.range : source?.statement;
    if (source?.uri !== undefined && range !== undefined) {
      this.host.select(source.uri, range);
    }
  }

  private problem(
    message: string,
    parameters: PlantResult['parameters'],
    lastGeneration: number | null,
  ): void {
    this.show({
      type: 'problem',
      message,
      parameters,
      lastGeneration,
      options: this.options,
      title: this.title,
    });
  }

  private show(message: ToPage): void {
    this.shown = message;
    this.host.post(message);
  }
}
