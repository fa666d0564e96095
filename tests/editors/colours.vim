" SPDX-License-Identifier: MIT
" Colours of sample.lsys in Vim or Neovim, with `editors/vim` in the runtime path.
" Usage: vim -es -u NONE -i NONE -N --cmd 'set rtp^=editors/vim' -S colours.vim sample.lsys
let s:failures = []

" The text at a place, and the syntax groups that it may have; '' means no group.
let s:expected = [
  \ [1, '// A', 'lsysLineComment'],
  \ [2, '#n', 'lsysStatement'], [2, '4', 'lsysNumber'], [2, '// gen', 'lsysLineComment'],
  \ [3, 'angle', 'lsysSetting'], [3, '25', 'lsysNumber'],
  \ [4, 'parallel', 'lsysValue'],
  \ [5, '0.75', 'lsysNumber'], [5, '{', 'lsysOperator'], [5, '// a', 'lsysLineComment'],
  \ [6, 'shrink', 'lsysFunction'], [7, 'colour', 'lsysMaterialKey'],
  \ [8, 'LEAF', 'lsysObject'], [9, '+', 'lsysTurtle'],
  \ [10, 'lsc', 'lsysAllow'],
  \ [11, '#w', 'lsysStatement'], [11, '//F', 'lsysTurtle'], [11, 'F(', 'lsysCommand'],
  \ [11, 'A(8', 'lsysModule'], [11, '8', 'lsysNumber'], [11, 'trunk', 'lsysComment'],
  \ [11, 'L;', 'lsysModule'],
  \ [12, '#grow', 'lsysLabel'], [12, '< A', 'lsysContext'], [12, 'A(x) >', 'lsysModule'],
  \ [12, '&&', 'lsysOperator'], [12, 'sin', 'lsysBuiltin'],
  \ [13, 'let', 'lsysStatement'], [13, '0.4', 'lsysNumber'], [13, 'if', 'lsysBuiltin'],
  \ [14, '[', 'lsysBranch'], [14, 'A(shrink', 'lsysModule'], [14, 'shrink', 'lsysFunction'],
  \ [14, '//(', 'lsysTurtle'], [14, '`', 'lsysQuoted'], [14, 'L;', 'lsysModule'],
  \ [15, '<=', 'lsysOperator'], [15, '{.', 'lsysPolygon'], [15, '%', 'lsysCut'],
  \ [16, '#define', 'lsysLabel'], [16, 'C;', 'lsysModule'], [16, '// a', 'lsysLineComment'],
  \ [17, '#decompose', 'lsysStage'], [17, 'd :', 'lsysLabel'], [17, 'C;', 'lsysModule'],
  \ ]

filetype plugin on
syntax on
edit
if &filetype !=# 'lsys'
  call add(s:failures, 'the file type is "' . &filetype . '"')
endif
if &commentstring !=# '// %s'
  call add(s:failures, 'the comment string is "' . &commentstring . '"')
endif
for [s:line, s:text, s:group] in s:expected
  let s:column = stridx(getline(s:line), s:text) + 1
  let s:name = synIDattr(synID(s:line, s:column, 1), 'name')
  if s:column == 0 || s:name !=# s:group
    call add(s:failures, s:line . ': ' . s:text . ': ' . s:name . ' instead of ' . s:group)
  endif
endfor
call writefile(s:failures, '/dev/stderr')
if !empty(s:failures)
  cquit
endif
qall!
