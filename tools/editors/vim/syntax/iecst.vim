" SPDX-License-Identifier: Apache-2.0
" Colours of Structured Text, IL, charts and networks, for Vim and Neovim.
if exists('b:current_syntax')
  finish
endif
syntax case ignore
syntax match iecstWord /\<\%(END_\a\+\%(_\a\+\)\?\|VAR\%(_\a\+\)\{0,2}\|FUNCTION_BLOCK\|INITIAL_STEP\|AND_THEN\|OR_ELSE\|REF_TO\|NON_RETAIN\|__\a\+\)\>/
syntax keyword iecstDeclaration PROGRAM FUNCTION METHOD PROPERTY INTERFACE CLASS ACTION NAMESPACE USING CONFIGURATION RESOURCE TASK TYPE STRUCT
syntax keyword iecstDeclaration UNION ARRAY POINTER REFERENCE STEP TRANSITION GET SET
syntax keyword iecstModifier CONSTANT RETAIN PERSISTENT EXTENDS IMPLEMENTS ABSTRACT FINAL OVERRIDE PUBLIC PRIVATE PROTECTED INTERNAL AT WITH ON FROM
syntax keyword iecstControl IF THEN ELSIF ELSE CASE OF FOR TO BY DO WHILE REPEAT UNTIL EXIT CONTINUE RETURN JMP
syntax keyword iecstOperator AND OR XOR NOT MOD
syntax keyword iecstConstant TRUE FALSE NULL THIS SUPER
syntax keyword iecstType BOOL BYTE WORD DWORD LWORD SINT INT DINT LINT USINT UINT UDINT ULINT REAL LREAL TIME LTIME DATE LDATE TOD LTOD DT LDT
syntax keyword iecstType TIME_OF_DAY LTIME_OF_DAY DATE_AND_TIME LDATE_AND_TIME CHAR WCHAR STRING WSTRING
syntax match iecstNumber /\<\d[0-9_]*\%(\.\d[0-9_]*\)\?\%(e[-+]\?\d\+\)\?\>\|\<\%(2\|8\|16\)#\x[0-9a-f_]*\>/
syntax match iecstNumber /\<\%(L\?T\%(IME\)\?\|L\?D\%(ATE\)\?\|L\?TOD\|L\?DT\)#[0-9a-z_.:-]\+/
syntax match iecstAddress /%[IQM]\%(\*\|[XBWDL]\?[0-9.]\+\)/
syntax region iecstString start=/'/ skip=/\$./ end=/'/ oneline
syntax region iecstString start=/"/ skip=/\$./ end=/"/ oneline
syntax region iecstPragma start=/{/ end=/}/ contains=iecstString
syntax match iecstComment /\/\/.*$/ contains=@Spell
syntax region iecstComment start=/(\*/ end=/\*)/ contains=iecstComment,@Spell
syntax region iecstComment start=/\/\*/ end=/\*\// contains=iecstComment,@Spell
highlight default link iecstWord Keyword
highlight default link iecstDeclaration Keyword
highlight default link iecstModifier StorageClass
highlight default link iecstControl Statement
highlight default link iecstOperator Operator
highlight default link iecstConstant Boolean
highlight default link iecstType Type
highlight default link iecstNumber Number
highlight default link iecstAddress Constant
highlight default link iecstString String
highlight default link iecstPragma PreProc
highlight default link iecstComment Comment
let b:current_syntax = 'iecst'
