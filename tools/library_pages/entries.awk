# The entries of a library page. In: first the programs of samples/library, then the library's files; `library`, its
# name; `complaints`, a file for what is wrong. Out: Markdown. Called by library_pages.sh.
function trimmed(text) { gsub(/^[ \t]+|[ \t]+$/, "", text); return text }
function complain(text) { print text >>complaints }
function baseOf(path) { sub(/.*\//, "", path); sub(/\.st$/, "", path); return path }

# `  {alias R} {lazy} RESET : BOOL := TRUE;  /// wins`
function pin(line, comment,  notes, word) {
  notes = ""
  while (match(line, /\{[^}]*\}/)) {
    word = substr(line, RSTART + 1, RLENGTH - 2)
    line = substr(line, 1, RSTART - 1) substr(line, RSTART + RLENGTH)
    if (word ~ /^alias/) { gsub(/alias |\047/, "", word); notes = notes ", also `" word "`" }
    else if (word == "extensible") notes = notes ", may be repeated"
    else if (word == "lazy") notes = notes ", evaluated only when chosen"
    else if (word == "required") notes = notes ", must be connected"
  }
  return "`" trimmed(line) "`" notes (comment != "" ? " (" comment ")" : "")
}
# The declarations of one line of a section, which may begin and end in it.
function declarations(line,  comment, parts, count, i, kind) {
  comment = ""
  if (match(line, /\/\/\/.*/)) { comment = trimmed(substr(line, RSTART + 3)); line = substr(line, 1, RSTART - 1) }
  sub(/\/\/.*/, "", line)
  if (match(line, /^VAR[A-Z_]*/)) { section = substr(line, 1, RLENGTH); line = substr(line, RLENGTH + 1) }
  count = split(line, parts, ";")
  for (i = 1; i <= count; ++i) {
    line = trimmed(parts[i])
    if (line == "END_VAR") section = ""
    if (line == "" || member || section !~ /^VAR_(INPUT|OUTPUT|IN_OUT)$/) continue
    kind = section == "VAR_INPUT" ? "in" : section == "VAR_OUTPUT" ? "out" : "in-out"
    list = list "- " kind " " pin(line, comment) "\n"
  }
}

# A line of a type: fields end with `;`, items are separated by `,`.
function typed(line,  comment, parts, count, i) {
  comment = ""
  if (match(line, /\/\/\/.*/)) { comment = trimmed(substr(line, RSTART + 3)); line = substr(line, 1, RSTART - 1) }
  sub(/\/\/.*/, "", line)
  gsub(/STRUCT( EXTENDS [A-Za-z_0-9.]+)?|UNION|END_STRUCT|END_UNION|END_TYPE|:$|^\(/, "", line)
  if (holds == "item") {
    if (match(line, /\) *[A-Z]*.*;/)) { base = trimmed(substr(line, RSTART + 1, RLENGTH - 2)); line = substr(line, 1, RSTART - 1) }
    if (base ~ /^:=/) base = ""
  }
  count = split(line, parts, holds == "item" ? "," : ";")
  for (i = 1; i <= count; ++i) {
    line = trimmed(parts[i])
    if (line == "" || line ~ /^END_|^\(|^\{/) continue
    list = list "- " holds " " pin(line, comment) "\n"
  }
}

# As GitHub makes them from headings.
function anchorOf(heading) {
  heading = tolower(heading)
  gsub(/[^a-z0-9_ -]/, "", heading)
  gsub(/ /, "-", heading)
  return heading
}
# The program with its diagram, or a link to the entry that has them.
function example(program, heading,  name, picture, command) {
  if (program in anchors) return "Example: [" titles[program] "](#" anchors[program] ").\n"
  anchors[program] = anchorOf(heading)
  titles[program] = heading
  name = baseOf(program)
  command = verbs[program] " " name ".st" (options[program] != "" ? " " options[program] : "")
  picture = ""
  if (draws(program)) {
    picture = "![Timing diagram of " heading "](diagrams/" library "/" name ".svg)\n\n"
    command = command " --plot " name ".svg"
  }
  return purposes[program] "\n\n" picture "```st " verbs[program] (options[program] != "" ? " " options[program] : "") "\n" \
         texts[program] "```\n" (outputs[program] != "" ? "```output\n" outputs[program] "```\n" : "") \
         "\nFile `" program "`: `rung " command "`\n"
}
function examplesOf(names, heading,  count, i, k, programs, all, text, seen) {
  text = ""
  count = split(names, all, " ")
  for (i = 1; i <= count; ++i) {
    if (!(all[i] in shown)) continue
    is_used[all[i]] = 1
    split(shown[all[i]], programs, " ")
    for (k = 1; k in programs; ++k) {
      if (programs[k] in seen) continue
      seen[programs[k]] = 1
      text = text "\n" example(programs[k], heading)
    }
  }
  return text
}
function draws(program) { return options[program] ~ /--watch/ && outputs[program] == "" }
# A block has state: a program draws it, or there is a reason.
function checkDiagram(names,  all, count, i, programs, k) {
  count = split(names, all, " ")
  for (i = 1; i <= count; ++i) {
    if ((library, all[i]) in reasons) return
    split(all[i] in shown ? shown[all[i]] : "", programs, " ")
    for (k = 1; k in programs; ++k) if (draws(programs[k])) return
  }
  complain("library " library ": no program in samples/library/" library " draws `" all[1] "` and without_diagram.tsv gives no reason")
}

function flush(  i) {
  for (i = 1; i <= count; ++i) {
    if (i == 1) print "\n## " toupper(substr(file, 1, 1)) substr(file, 2)
    print "\n### " first[order[i]]
    has_entry = 1
    if (order[i] != "") print "\n" substr(order[i], 1, length(order[i]) - 1)
    if (pins[order[i]] != "") print "\n" pins[order[i]]
    if (others[order[i]] != "") print "\nAlso " substr(others[order[i]], 3) "."
    printf "%s", examplesOf(names[order[i]], first[order[i]])
    if (is_block[order[i]]) checkDiagram(names[order[i]])
  }
  count = 0
}

BEGIN {
  while ((getline line <"samples/library/without_diagram.tsv") > 0) {
    if (line ~ /^#/) continue
    split(line, fields, "\t")
    if (fields[3] == "") complain("samples/library/without_diagram.tsv: `" line "` has no reason")
    reasons[fields[1], fields[2]] = 1
  }
}

# ---- programs

FILENAME ~ /^samples\/library\// {
  if (FNR == 1) { purposes[FILENAME] = trimmed(substr($0, 3)); next }
  if (/^\/\/ shows: /) {
    for (i = 3; i <= NF; ++i) shown[$i] = shown[$i] FILENAME " "
  } else if (/^\/\/ (run|test): ?/) {
    verbs[FILENAME] = substr($2, 1, length($2) - 1)
    options[FILENAME] = trimmed(substr($0, index($0, ":") + 1))
  } else if (/^\/\/ output: /) {
    outputs[FILENAME] = outputs[FILENAME] substr($0, 12) "\n"
  } else {
    texts[FILENAME] = texts[FILENAME] $0 "\n"
  }
  next
}

# ---- declarations. One is complete at its END_…; those of members (method, action, property) are not pins.

FNR == 1 {
  flush()
  delete first
  delete others
  delete names
  delete is_block
  file = baseOf(FILENAME)
  doc = ""; std = ""; section = ""
}
section == "" && /^\/\/\// { doc = doc trimmed(substr($0, 4)) "\n"; next }
section == "" && /^\{/ { if (match($0, /std \047[^\047]*/)) std = substr($0, RSTART + 5, RLENGTH - 5); next }
!inside && /^FUNCTION/ {
  inside = 1; member = 0; list = ""; about = doc; doc = ""
  block = $1 == "FUNCTION_BLOCK"
  result = ""
  if ($1 == "FUNCTION" && /:/) { result = $0; sub(/^[^:]*: */, "", result); sub(/ *\/\/.*/, "", result) }
  for (i = 2; $i ~ /^(FINAL|ABSTRACT|PUBLIC|INTERNAL)$/; ++i) continue
  name = $i
  next
}
inside && /^(METHOD|ACTION|PROPERTY)/ {
  member = 1
  if ($0 !~ /^[A-Z]+ (PRIVATE|PROTECTED|INTERNAL)/) {
    line = $0; kind = tolower($1)
    sub(/^[A-Z]+ (PUBLIC )?/, "", line)
    comment = doc; sub(/\n$/, "", comment); gsub(/\n/, " ", comment)
    if (match(line, /\/\/\/.*/)) { comment = trimmed(substr(line, RSTART + 3)); line = substr(line, 1, RSTART - 1) }
    sub(/\/\/.*/, "", line)
    list = list "- " kind " `" trimmed(line) "`" (comment != "" ? " (" comment ")" : "") "\n"
  }
  doc = ""
  next
}
/^END_(METHOD|ACTION|PROPERTY)/ { member = 0; next }
inside && (section != "" || /^VAR/) { declarations($0); next }
inside && /^END_FUNCTION/ {
  inside = 0
  names[about] = names[about] name " "
  if (block) is_block[about] = 1
  if (result != "") list = list "- result `" result "`\n"
  if (std != "") name = name " (" std ")"
  sub(/ iec3\)/, ", iec3)", name)
  if (std == "" && about in first) {
    others[about] = others[about] ", " name
  } else {
    first[about] = name
    pins[about] = substr(list, 1, length(list) - 1)
    order[++count] = about
  }
  doc = ""; std = ""
  next
}
# `TYPE name : STRUCT … END_STRUCT END_TYPE`, `TYPE name : (…); END_TYPE`, `TYPE name : other; END_TYPE`
!inside && !type && /^TYPE [A-Za-z_]/ && doc != "" {
  name = $2; sub(/:.*/, "", name)
  type = doc; list = ""; base = ""
  doc = ""
  names[type] = name
  if (std != "") name = name " (" std ")"
  std = ""
  first[type] = name; order[++count] = type
  sub(/^TYPE [A-Za-z_0-9]+ *:? */, "")
  holds = /STRUCT|UNION/ ? "field" : /^\(/ || $0 == "" ? "item" : "type"
}
type {
  if (holds == "item" && /^ *(STRUCT|UNION)/) holds = "field"
  typed($0)
  if (/END_TYPE/) {
    if (base != "") list = list "- base type `" base "`\n"
    pins[type] = substr(list, 1, length(list) - 1)
    type = ""
  }
  next
}
!inside { doc = ""; std = "" }
END {
  flush()
  has_example = 0
  for (program in anchors) has_example = 1
  if (has_entry && !has_example) complain("library " library ": no program in samples/library/" library)
  for (name in shown)
    if (!(name in is_used)) complain("samples/library/" library ": `" name "` of a `// shows: ` line has no entry on the page")
}
