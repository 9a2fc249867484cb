" SPDX-License-Identifier: Apache-2.0
" Comments and indentation of Structured Text.
if exists('b:did_ftplugin')
  finish
endif
let b:did_ftplugin = 1
setlocal commentstring=//\ %s comments=:///,://,s:(*,mb:*,ex:*) expandtab shiftwidth=2 softtabstop=2 autoindent
