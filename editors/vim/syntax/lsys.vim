" Vim syntax file
" Language: L-system grammar (.lsys)
" Made by write_syntax from editors/syntax/lsys.vim.in and the tables of the compiler.
" SPDX-License-Identifier: MIT

if exists('b:current_syntax')
  finish
endif
let s:saved_cpo = &cpo
set cpo&vim

syn case match
syn sync fromstart

" Comments: /* */ everywhere, // only between statements.
syn region lsysComment start="/\*" end="\*/" contains=lsysAllow,@Spell
syn match lsysAllow contained "lsc:\s*allow\s\+[a-z0-9-]\+"
syn match lsysLineComment "//.*$" contains=@Spell

syn cluster lsysExpression contains=lsysComment,lsysNumber,lsysFunction,lsysOperator,lsysRange,lsysParens
syn match lsysNumber contained "\%(\h\w*\)\@<!\%(\d\+\.\=\d*\|\.\d\+\)\%([eE][-+]\=\d\+\)\="
syn match lsysFunction contained "\<\h\w*\ze\s*("
syn match lsysOperator contained "[-+*/^<>=!&|~]"
syn region lsysRange contained matchgroup=lsysOperator start="{" end="}\|;\@=" contains=@lsysExpression
syn region lsysParens contained matchgroup=lsysDelimiter start="(" end=")\|;\@=" contains=@lsysExpression

syn cluster lsysModules contains=lsysComment,lsysQuoted,lsysModule,lsysCommand,lsysTurtle,lsysBranch,lsysPolygon,lsysCut,lsysParens
syn match lsysModule contained "\h\w*"
syn match lsysCommand contained "\<\%(F\|f\)\>"
syn match lsysTurtle contained "[-+\\^&|$!\"']\|/\*\@!"
syn match lsysBranch contained "[][]"
syn match lsysPolygon contained "[{}.]"
syn match lsysCut contained "%"
syn match lsysQuoted contained "`[^`]*`"
syn match lsysString contained "\"[^\"]*\""

" Productions: #label : head : condition : successor;
syn region lsysProduction matchgroup=lsysLabel start="#\h\w*\_s*:" matchgroup=lsysDelimiter end=";" contains=@lsysModules,lsysContext,lsysCondition
syn region lsysProduction matchgroup=lsysStage start="#\%(decompose\|interpret\|down\|up\)\>\%(\_s*:\)\@!" matchgroup=lsysDelimiter end=";" contains=lsysComment,lsysStageHead
syn region lsysStageHead contained matchgroup=lsysLabel start="\h\w*\_s*:" end=";\@=" contains=@lsysModules,lsysContext,lsysCondition
syn match lsysContext contained "[<>]"
syn region lsysCondition contained matchgroup=lsysDelimiter start=":" end=";\@=" contains=@lsysExpression,lsysSuccessor
syn region lsysSuccessor contained matchgroup=lsysDelimiter start=":" end=";\@=" contains=@lsysModules,lsysLet
syn region lsysLet contained matchgroup=lsysStatement start="\<let\>\%(\_s*\h\w*\_s*=[^=]\)\@=" matchgroup=lsysDelimiter end=":\|;\@=" contains=@lsysExpression

" Other statements. They come after the productions, so they win where both match.
syn region lsysValues matchgroup=lsysStatement start="#\%(contour\|curve\|define\|function\|include\|module\|n\|object\|param\)\>\%(\_s*:\)\@!" matchgroup=lsysDelimiter end=";" contains=@lsysExpression,lsysString,lsysQuoted,lsysObject
syn keyword lsysObject contained BEND BRANCH CONE CONTOUR CUBE CYLINDER DISK FLOWER HETEROCYST LEAF SPHERE SURFACE_BEGIN SURFACE_END SURFACE_POINT SURFACE_RADII SURFACE_TANGENTS
syn region lsysSet matchgroup=lsysStatement start="#set\>\%(\_s*:\)\@!" matchgroup=lsysDelimiter end=";" contains=@lsysExpression,lsysSetting,lsysValue
syn match lsysSetting contained "\%(#set\_s\+\)\@<=\%(angle\|angle_scale\|at_depth\|choice\|collar\|colour\|colour_increment\|damping\|decompose_depth\|density\|elasticity\|flare\|height\|interpret_depth\|load\|names\|pipe\|random\|rewriting\|scale\|seed\|sides\|spring\|step\|step_scale\|tips\|tropism\|tropisms\|turtle\|weights\|width\|width_increment\|width_scale\|width_unit\|word_shape\)\>"
syn keyword lsysValue contained abop any auto broken carey carried characters cpfg cyclic error flat fractint generation glibc houdini l3d l3d_program leftmost letters line lplus lplus_program lsys metres module one own parallel philox pixels ring round sequential sidefx stop sys thesis words
syn region lsysMaterial matchgroup=lsysStatement start="#material\>\%(\_s*:\)\@!" matchgroup=lsysDelimiter end=";" contains=@lsysExpression,lsysMaterialKey,lsysString
syn keyword lsysMaterialKey contained colour normal picture roughness translucency two_sided
syn region lsysSense matchgroup=lsysStatement start="#sense\>\%(\_s*:\)\@!" matchgroup=lsysDelimiter end=";" contains=@lsysExpression,lsysSenseKey,lsysSenseKind,lsysString
syn keyword lsysSenseKey contained angle at cell count directions extinction file high kill levels low mesh plane radius ratio shape size strength
syn keyword lsysSenseKind contained ball box cone crowd dome map program shadow sky solid space
syn region lsysNames matchgroup=lsysStatement start="#\%(ignore\|consider\)\>\_s*:" matchgroup=lsysDelimiter end=";" contains=@lsysModules
syn region lsysAxiom matchgroup=lsysStatement start="#w\_s*\%([:~]\)\@=" matchgroup=lsysDelimiter end=";" contains=@lsysExpression,lsysSuccessor

" The functions of the language come after names before parentheses, so they win.
syn match lsysBuiltin contained "\<\%(abs\|acos\|asin\|atan\|atan2\|binomial\|ceil\|clamp\|cos\|exp\|floor\|if\|log\|max\|min\|mix\|mod\|normal\|poisson\|pow\|round\|sign\|sin\|sqrt\|step\|steps\|tan\)\ze\s*("
syn cluster lsysExpression add=lsysBuiltin

hi def link lsysComment Comment
hi def link lsysLineComment Comment
hi def link lsysAllow SpecialComment
hi def link lsysNumber Number
hi def link lsysFunction Function
hi def link lsysBuiltin Function
hi def link lsysOperator Operator
hi def link lsysModule Identifier
hi def link lsysCommand Special
hi def link lsysTurtle Special
hi def link lsysBranch Delimiter
hi def link lsysPolygon Structure
hi def link lsysCut Exception
hi def link lsysQuoted String
hi def link lsysString String
hi def link lsysLabel Label
hi def link lsysStage Statement
hi def link lsysStatement Statement
hi def link lsysSetting Type
hi def link lsysValue Constant
hi def link lsysMaterialKey Type
hi def link lsysSenseKey Type
hi def link lsysSenseKind Constant
hi def link lsysObject Constant
hi def link lsysContext Operator
hi def link lsysDelimiter Delimiter

let b:current_syntax = 'lsys'
let &cpo = s:saved_cpo
unlet s:saved_cpo
