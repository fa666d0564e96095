// SPDX-License-Identifier: MIT
// esbuild imports style sheets as texts.
declare module '*.css' {
  const text: string;
  export default text;
}
