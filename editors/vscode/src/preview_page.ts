// SPDX-License-Identifier: MIT
// The HTML of the preview. Only the script of the extension may run in it.

export interface PageParts {
  /** The URI of preview.js. */
  script: string;
  /** The origin of resources of the extension, for the Content-Security-Policy. */
  source: string;
  nonce: string;
}

export function previewPage({ script, source, nonce }: PageParts): string {
  // three.js makes a blob: URL of each picture of a GLB, and fetches it.
  const policy = [
    "default-src 'none'",
    `script-src 'nonce-${nonce}'`,
    `style-src 'nonce-${nonce}'`,
    `img-src ${source} blob:`,
    'connect-src blob:',
  ].join('; ');
  return `<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="UTF-8">
<meta http-equiv="Content-Security-Policy" content="${policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Preview of a plant</title>
</head>
<body>
<script nonce="${nonce}" src="${script}"></script>
</body>
</html>
`;
}
