" SPDX-License-Identifier: MIT
autocmd BufNewFile,BufRead *.lsys setfiletype lsys
