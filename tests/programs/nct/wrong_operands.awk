# Writes a program in which each instruction of nc_instructions.tsv has each operand wrong once, and too few and too many,
# to wrong.nct; and the errors that they must have, to expected.txt. Labels are in errors.test.
function put(text) { print text > "wrong.nct"; ++line }
function word() { return sprintf("PLCRAM,#%d", 10 + 2 * next_word++) }
function good(kind) {
  if (kind ~ /^BIT/) return "PLCRAM.00,#" (10 + next_word++)
  if (kind == "scope") return "TachAx"
  return kind == "#" ? "#1" : word()
}
function wrong(kind) {
  if (kind == "scope") return "Nothing"
  if (kind == "#" || kind == "BIT written") return "PLCRAM"
  if (kind ~ /^DOUBLE/) return "PLCRAM.01"
  return kind ~ / # or|or #$/ ? "*1.0" : "#1"
}
function pins(names,    list, n, k) {
  n = split(names, list, " ")
  for (k = 1; k <= n; ++k) {
    put((k == 1 ? "  [ " : "  | ") list[k])
    put("    IN N_ON")
  }
  put("  ]")
}
# A rung with the element; `column` of `code`.
function rung(text, column, code) {
  put("RUNG")
  if ($1 in pins_of) pins(pins_of[$1])
  else put("  IN N_ON")
  put(text)
  print "wrong.nct:" line ":" column ": error[" code "]" > "expected.txt"
  if ($1 ~ /^(INN?|(C|FL)(LT|LE|EQ|NE|GE|GT))$/) put("  OUT " good("BIT written"))
}
function element(bad, value,    text, k) {
  text = "  " $1
  column = 3
  for (k = 1; k <= count; ++k) {
    if (k == bad) column = length(text) + 2
    text = text " " (k == bad ? value : good(kinds[k]))
  }
  return text
}
BEGIN {
  FS = "\t"
  pins_of["CNT"] = pins_of["CNTR"] = "CK U/D R"
  pins_of["SHTR"] = "CK L/R D"
  pins_of["ROT"] = "EN BID DIR INC PRE"
  put("PROGRAM wrong")
  put("MODULE MAIN")
}
$4 == "-" || $4 == "label" { next }
{
  count = split($4, kinds, "; ")
  least = $3 ~ /^3\.\.\./ ? 3 : count
  for (k = 1; k <= count; ++k) rung(element(k, wrong(kinds[k])), column, kinds[k] == "scope" ? "E1407" : "E1408")
  for (k = 1; k <= count; ++k) {
    if (kinds[k] ~ /written|kept/) {
      rung(element(k, kinds[k] ~ /BIT/ ? "MB_START" : "MKBTNS0"), column, "E1411")
      rung(element(k, kinds[k] ~ /BIT/ ? "FL_ER" : "FLAGS"), column, "E1411")
    }
    if (kinds[k] ~ /^DOUBLE/) rung(element(k, "9999"), column, "E1406")
    if (kinds[k] ~ /^(BIT|DWORD)/) rung(element(k, "PLCRAM,#4976"), column, "E1406")
    if (kinds[k] ~ /#$/ || kinds[k] ~ /# or/) rung(element(k, "#2147483648"), column, "E1405")
    if (kinds[k] ~ /#\$/) rung(element(k, "#$123456789"), column, "E1405")
  }
  count = least - 1
  rung(element(0), 3, "E1401")
  count = split($4, kinds, "; ")
  if (count < 5) rung(element(0) " PLCRAM", 3, "E1401")
}
END { put("END_MODULE") }
