// SPDX-License-Identifier: MIT
// Compares the npm package with native lsc: the words of at least 300 grammars of the samples and
// the golden tests, messages with fixes of grammars with mistakes, files, and use in Node.js.
// Usage: node words.mjs      LSC: the program to compare with (default build/release/lsc)
import { createHash } from 'node:crypto';
import { existsSync, readdirSync, readFileSync, statSync } from 'node:fs';
import { basename, dirname, join, relative } from 'node:path';
import { applyFix, diagnostics, derive, glb, load, LsysError, mesh, skeleton } from 'lsys';
import { check, finish, part, root, runLsc } from './support.mjs';

const kGrammars = 300;

function below(folder, extension) {
  return readdirSync(folder)
    .sort()
    .flatMap((name) => {
      const path = join(folder, name);
      const status = statSync(path);
      if (status.isDirectory()) return below(path, extension);
      // A golden test has a symbolic link to an endless device.
      return name.endsWith(extension) && status.isFile() ? [path] : [];
    });
}

/** The files in the folder of a grammar, and files elsewhere that it names; none if it names no file. */
function filesOf(path, text) {
  const named = [...text.matchAll(/"([^"\n]+\.\w+)"/g)].map((match) => match[1]);
  if (named.length === 0 && !text.includes('#include')) return {};
  const folder = dirname(path);
  const beside = ['.lsys', '.obj', '.mtl', '.png', '.jpg', '.txt']
    .flatMap((extension) => below(folder, extension))
    .map((file) => relative(folder, file));
  const elsewhere = named.filter(
    (file) => file.startsWith('../') && existsSync(join(folder, file)),
  );
  return Object.fromEntries(
    [...beside, ...elsewhere].map((file) => [file, readFileSync(join(folder, file))]),
  );
}

const lsys = await load();

await part('words equal those of lsc', () => {
  const paths = [
    ...below(join(root, 'samples'), '.lsys'),
    ...below(join(root, 'tests/ui'), '.lsys').filter((path) => !path.includes('/parts/')),
  ];
  let count = 0;
  let modules = 0;
  for (const path of paths) {
    const native = runLsc('dump', '-q', '-n', '4', '--seed', '7', '--max-modules', '2000000', path);
    if (native.status !== 0) continue;
    const bytes = readFileSync(path);
    const name = basename(path);
    let word = null;
    try {
      word = lsys.derive(bytes, {
        name,
        files: filesOf(path, bytes.toString('latin1')),
        generations: 4,
        seed: 7,
      });
    } catch (error) {
      check(false, `${path}: ${error}`);
      continue;
    }
    check(word.text === native.stdout.replace(/\n$/, ''), `${path}: the words differ`);
    modules += word.modules;
    ++count;
  }
  check(count >= kGrammars, `${count} grammars, not ${kGrammars}`);
  console.log(`${count} grammars, ${modules} modules`);
});

await part('messages equal those of lsc', () => {
  let count = 0;
  for (const path of below(join(root, 'tests/ui'), '.lsys')) {
    const text = readFileSync(path);
    if (path.includes('/parts/') || /#include|"/.test(text.toString('latin1'))) continue;
    const native = runLsc('check', '-q', '--message-format', 'json', '--warn', 'warnings', path);
    const wanted = native.stderr
      .split('\n')
      .filter(Boolean)
      .map((line) => JSON.parse(line))
      .filter((each) => each.code && each.severity === 'error')
      .map((each) => each.code);
    if (wanted.length === 0 || native.status !== 1) continue;
    const found = lsys
      .diagnostics(text, { name: basename(path) })
      .filter((each) => each.severity === 'error')
      .map((each) => each.code);
    check(JSON.stringify(found) === JSON.stringify(wanted), `${path}: ${found}, not ${wanted}`);
    ++count;
  }
  check(count >= 100, `${count} grammars with mistakes`);
  console.log(`${count} grammars with mistakes`);
});

await part('a fix repairs a grammar', () => {
  const broken = '#n = 2;\n#w : A(8);\n#p : A(x) : x > 1 : F(x) [+ A(x/2)];\n#q : A(x) : x < 1 : F(1);\n';
  const [message] = lsys.diagnostics(broken);
  check(message.code === 'condition-gap', message.code);
  check(message.place.line === 4 && message.place.column === 13, JSON.stringify(message.place));
  const fixed = applyFix(broken, message.fixes[0]);
  check(lsys.diagnostics(fixed).length === 0, fixed);
  const wide = '#w : F; /* 🌱 */ #p : F : * : F G(;\n'; // columns count UTF-16 code units
  const place = lsys.diagnostics(wide)[0].place;
  check(place.line === 1 && wide.slice(place.column - 1).startsWith('(;'), JSON.stringify(place));
});

await part('files equal those of lsc', () => {
  const path = join(root, 'samples/plant-fern/plant-fern.lsys');
  const text = readFileSync(path, 'utf8');
  const hash = (bytes) => createHash('sha256').update(bytes).digest('hex');
  const svg = lsys.write(text, 'plant.svg', { name: 'plant-fern.lsys' }).files[0];
  const native = runLsc('export', path, '-q', '--format', 'svg', '-o', '-');
  const plain = (drawing) => drawing.replace(/<desc>[^:]*:/, '<desc>program:');
  check(
    hash(plain(Buffer.from(svg.bytes).toString())) === hash(plain(native.stdout)),
    'the drawings differ',
  );
  const { files } = lsys.write(text, 'plant.obj');
  check(files.length > 1 && files.some((file) => file.name === 'plant.mtl'), 'no materials of OBJ');
  const lsb = lsys.bytecode(text);
  check(lsys.derive(lsb, { name: 'plant.lsb' }).text === lsys.derive(text).text, 'the .lsb differs');
});

await part('a forest, a growth, edits', () => {
  const text = '#n = 3;\n#param a 25 {10, 80};\n#set seed 1;\n#w : F;\n#p : F : * : F[+(a)F]F;\n';
  const { files } = lsys.forest(text, 'forest.glb', { scene: { count: 50, rho: 0 } });
  check(Buffer.from(files[0].bytes).subarray(0, 4).toString() === 'glTF', 'no GLB of a forest');
  check(lsys.beginGrowth(text) === 3, 'generations of a growth');
  const half = lsys.growthAt(1.5);
  const whole = lsys.growthAt(3);
  check(half.plant.segments > 0 && whole.plant.segments > half.plant.segments, 'growth');
  const edited = lsys.edit(text, { generations: 4, definitions: { a: 30 }, settings: { seed: '5' } });
  check(edited === text.replace('= 3', '= 4').replace('25', '30').replace('1;', '5;'), edited);
  check(lsys.format('#w:F;').trim() === '#w : F;', 'format');
});

await part('failures', () => {
  const status = (action) => {
    try {
      action();
      return 'ok';
    } catch (error) {
      return error instanceof LsysError ? error.status : String(error);
    }
  };
  check(status(() => lsys.derive('#w : F')) === 'diagnosed', 'a syntax error');
  check(
    status(() =>
      lsys.derive('#n = 60; #w : F; #p : F : ~ 0.9 : F F; #q : F : ~ 0.1 : F;', {
        maxModules: 1e6,
      }),
    ) === 'limit',
    'a word that is too long',
  );
  check(status(() => lsys.derive('#n = 1; #w : F;')) === 'ok', 'an instance after a failure');
  check(status(() => lsys.write('#n = 1; #w : F;', 'plant.doc')) === 'failed', 'a format');
});

await part('functions of the package', async () => {
  const text = '#n = 2; #w : F; #p : F : * : F[+F]F;';
  check((await derive(text)).text === 'F[+F]F[+F[+F]F]F[+F]F', 'derive');
  check((await skeleton(text)).segments.count === 9, 'skeleton');
  const made = await mesh(text);
  check(made.indices.length > 0 && made.indices.every((i) => 3 * i < made.positions.length), 'mesh');
  check(Buffer.from(await glb(text)).subarray(0, 4).toString() === 'glTF', 'glb');
  check((await diagnostics('#w : ;')).length > 0, 'diagnostics');
});

finish();
