" Vim filetype plugin
" Language: L-system grammar (.lsys)
" SPDX-License-Identifier: MIT

if exists('b:did_ftplugin')
  finish
endif
let b:did_ftplugin = 1

setlocal comments=s1:/*,mb:*,ex:*/,:// commentstring=//\ %s
setlocal iskeyword=@,48-57,_
setlocal suffixesadd=.lsys
setlocal include=^\\s*#include
setlocal define=^\\s*#\\%(define\\\|param\\\|function\\\|curve\\\|module\\\|object\\)
let b:undo_ftplugin = 'setlocal comments< commentstring< iskeyword< suffixesadd< include< define<'

" :make checks the grammar and fills the quickfix list.
if executable('lsc')
  setlocal makeprg=lsc\ check\ --message-format\ short\ %:S
  setlocal errorformat=%f:%l:%c:\ %t%*[a-z]:\ %m,%-G%.%#
  let b:undo_ftplugin .= ' | setlocal makeprg< errorformat<'
endif
