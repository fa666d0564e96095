// SPDX-License-Identifier: MIT
// The extension: starts `lsc lsp`, and shows plants beside their grammars.

import { randomBytes } from 'node:crypto';
import { homedir } from 'node:os';
import * as vscode from 'vscode';
import { LanguageClient, RevealOutputChannelOn, State } from 'vscode-languageclient/node';
import { findProgram } from './find_program';
import type { FromPage, ToPage } from './messages';
import { PlantSession, type PreviewLimits } from './plant_session';
import { previewPage } from './preview_page';
import { plantMethod, type PlantParams, type PlantResult, type Range } from './protocol';

let client: LanguageClient | undefined;
let starting: Promise<void> | undefined;

function setting<T>(name: string): T | undefined {
  return vscode.workspace.getConfiguration('lsys').get<T>(name);
}

async function offerSettings(problem: string): Promise<void> {
  const open = 'Open Settings';
  const answer = await vscode.window.showErrorMessage(
    `L-system grammars need the compiler lsc. ${problem} ` +
      'Install it, or set `lsys.path` to its path, such as `~/.local/bin/lsc`.',
    open,
  );
  if (answer === open) {
    await vscode.commands.executeCommand('workbench.action.openSettings', 'lsys.path');
  }
}

async function startServer(): Promise<void> {
  const found = findProgram(setting<string>('path') ?? 'lsc', {
    home: homedir(),
    folder: vscode.workspace.workspaceFolders?.[0]?.uri.fsPath,
    searched: process.env['PATH'] ?? '',
    windows: process.platform === 'win32',
  });
  if ('problem' in found) {
    void offerSettings(found.problem); // waits for the user
    return;
  }
  client = new LanguageClient(
    'lsys',
    'L-system grammars',
    { command: found.program, args: ['lsp'] },
    {
      // Files with extensions of other programs' grammars get diagnostics, too.
      documentSelector: [{ language: 'lsys' }, { scheme: 'file', pattern: '**/*.{hlsys,l3d,l++,lss}' }],
      revealOutputChannelOn: RevealOutputChannelOn.Never,
      synchronize: { fileEvents: vscode.workspace.createFileSystemWatcher('**/*.lsys') },
    },
  );
  try {
    await client.start();
  } catch (error) {
    void vscode.window.showErrorMessage(
      `\`${found.program} lsp\` does not start: ${(error as Error).message}`,
    );
  }
}

async function stopServer(): Promise<void> {
  const running = client;
  client = undefined;
  if (running !== undefined && running.state !== State.Stopped) {
    await running.stop();
  }
}

/** The plant of a grammar, or the reason why there is none. */
async function requestPlant(params: PlantParams): Promise<PlantResult> {
  await starting;
  if (client === undefined || client.state === State.Stopped) {
    throw new Error('lsc does not run: set `lsys.path`, and run the command “L-system: Restart lsc”');
  }
  const experimental = client.initializeResult?.capabilities.experimental as
    | { lsysPlant?: boolean }
    | undefined;
  if (experimental?.lsysPlant !== true) {
    throw new Error('this version of lsc has no previews: install a newer one');
  }
  return client.sendRequest<PlantResult>(plantMethod, params);
}

/** The uri of a document as the client sends it to the server. */
function serverUri(document: vscode.TextDocument): string {
  return client?.code2ProtocolConverter.asUri(document.uri) ?? document.uri.toString();
}

function toRange(range: Range): vscode.Range {
  return new vscode.Range(
    range.start.line,
    range.start.character,
    range.end.line,
    range.end.character,
  );
}

/** A preview: a webview with its session. */
class Preview {
  private static readonly open = new Map<string, Preview>();
  private readonly session: PlantSession;
  private readonly disposables: vscode.Disposable[] = [];

  private constructor(
    private readonly panel: vscode.WebviewPanel,
    private readonly document: vscode.TextDocument,
    extension: vscode.Uri,
  ) {
    const key = document.uri.toString();
    Preview.open.set(key, this);
    this.session = new PlantSession(serverUri(document), document.fileName, {
      request: requestPlant,
      post: (message: ToPage) => void panel.webview.postMessage(message),
      select: (uri, range) => void this.select(uri, toRange(range)),
      limits: (): PreviewLimits => ({
        maxModules: setting('preview.maxModules'),
        maxTriangles: setting('preview.maxTriangles'),
        maxSeconds: setting('preview.maxSeconds'),
        textures: setting('preview.textures'),
      }),
    });
    this.disposables.push(
      panel.webview.onDidReceiveMessage((message: FromPage) => this.session.receive(message)),
      panel.onDidDispose(() => {
        Preview.open.delete(key);
        this.disposables.forEach((each) => each.dispose());
      }),
      vscode.workspace.onDidChangeTextDocument((event) => {
        // The grammar that is shown may include the changed file.
        if (event.document.languageId === 'lsys' && event.contentChanges.length > 0) {
          void this.session.refresh();
        }
      }),
      vscode.workspace.onDidChangeConfiguration((event) => {
        if (event.affectsConfiguration('lsys.preview')) {
          void this.session.refresh();
        }
      }),
      vscode.window.onDidChangeTextEditorSelection((event) => {
        if (event.textEditor.document.languageId === 'lsys') {
          this.followCursor(event.textEditor);
        }
      }),
    );
    const script = panel.webview.asWebviewUri(vscode.Uri.joinPath(extension, 'dist', 'preview.js'));
    panel.webview.html = previewPage({
      script: script.toString(),
      source: panel.webview.cspSource,
      nonce: randomBytes(16).toString('hex'),
    });
  }

  static show(editor: vscode.TextEditor, extension: vscode.Uri): void {
    const known = Preview.open.get(editor.document.uri.toString());
    if (known !== undefined) {
      known.panel.reveal(undefined, true);
      return;
    }
    const name = vscode.workspace.asRelativePath(editor.document.uri).split(/[/\\]/).pop();
    const panel = vscode.window.createWebviewPanel(
      'lsys.preview',
      `Plant of ${name ?? ''}`,
      { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true },
      {
        enableScripts: true,
        retainContextWhenHidden: true,
        localResourceRoots: [vscode.Uri.joinPath(extension, 'dist')],
      },
    );
    panel.iconPath = vscode.Uri.joinPath(extension, 'icons', 'extension.png');
    new Preview(panel, editor.document, extension);
  }

  static refreshAll(): void {
    Preview.open.forEach((preview) => void preview.session.refresh());
  }

  private followCursor(editor: vscode.TextEditor): void {
    if (setting<boolean>('preview.followCursor') === false) {
      this.session.clearHighlight();
      return;
    }
    this.session.moveCursor(serverUri(editor.document), editor.selection.active);
  }

  private async select(uri: string, range: vscode.Range): Promise<void> {
    const target = client?.protocol2CodeConverter.asUri(uri) ?? vscode.Uri.parse(uri);
    const beside = vscode.window.visibleTextEditors.find(
      (editor) => editor.document.uri.toString() === target.toString(),
    );
    const column =
      beside?.viewColumn ??
      vscode.window.visibleTextEditors.find((editor) => editor.document === this.document)
        ?.viewColumn ??
      vscode.ViewColumn.One;
    const editor = await vscode.window.showTextDocument(target, { viewColumn: column });
    editor.selection = new vscode.Selection(range.start, range.end);
    editor.revealRange(range, vscode.TextEditorRevealType.InCenterIfOutsideViewport);
  }
}

export function activate(context: vscode.ExtensionContext): void {
  context.subscriptions.push(
    vscode.commands.registerCommand('lsys.preview', () => {
      const editor = vscode.window.activeTextEditor;
      if (editor?.document.languageId === 'lsys') {
        Preview.show(editor, context.extensionUri);
      } else {
        void vscode.window.showInformationMessage('Open an L-system grammar (.lsys) first.');
      }
    }),
    vscode.commands.registerCommand('lsys.restart', async () => {
      await stopServer();
      starting = startServer();
      await starting;
      Preview.refreshAll();
    }),
    vscode.workspace.onDidChangeConfiguration(async (event) => {
      if (event.affectsConfiguration('lsys.path')) {
        await vscode.commands.executeCommand('lsys.restart');
      }
    }),
  );
  starting = startServer();
}

export async function deactivate(): Promise<void> {
  await stopServer();
}
