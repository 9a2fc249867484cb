#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks files by the rules of PLCopen TC6 XML 2.01: which elements stand where, in which order and how often, which
attributes they have and of what form; beyond the schema, that a localId stands once in a body and that every wire
leads to one. What stands in the `data` of an addData is of others.

    tc6.py FILE...        one line for each mistake; exit code 1 when there is one
"""
import re
import sys
import xml.etree.ElementTree as ET

TC6, XHTML = "{http://www.plcopen.org/xml/tc6_0201}", "{http://www.w3.org/1999/xhtml}"

FORMS = {
    "text": r".*",
    "id": r"\d+",
    "number": r"[+-]?(\d+(\.\d*)?|\.\d+)",
    "flag": r"true|false|0|1",
    "edge": r"none|falling|rising",
    "storage": r"none|set|reset",
    "access": r"readOnly|readWrite",
    "pou": r"function|functionBlock|program",
    "unknown": r"preserve|discard|implementation",
    "qualifier": r"P1|N|P0|R|S|L|D|P|DS|DL|SD|SL",
    "time": r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d(\.\d+)?(Z|[+-]\d\d:\d\d)?",
}
for name in FORMS:
    FORMS[name] = re.compile(FORMS[name], re.S)

DATA = "addData? documentation?"
ELEMENTARY = ("BOOL BYTE WORD DWORD LWORD SINT INT DINT LINT USINT UINT UDINT ULINT REAL LREAL TIME DATE DT TOD "
              "ANY ANY_DERIVED ANY_ELEMENTARY ANY_MAGNITUDE ANY_NUM ANY_REAL ANY_INT ANY_BIT ANY_STRING ANY_DATE").split()
A_TYPE = "(" + " | ".join(ELEMENTARY) + (" | string | wstring | array | derived | enum | struct | subrangeSigned |"
                                        " subrangeUnsigned | pointer)")
A_VALUE = "(simpleValue | arrayValue | structValue)"
COMMON = "comment | error | connector | continuation | actionBlock | vendorElement"
FBD = COMMON + " | block | inVariable | outVariable | inOutVariable | label | jump | return"
LD = FBD + " | leftPowerRail | rightPowerRail | coil | contact"
SFC = LD + (" | step | macroStep | jumpStep | transition | selectionDivergence | selectionConvergence |"
            " simultaneousDivergence | simultaneousConvergence")
LISTS = "localVars | tempVars | inputVars | outputVars | inOutVars | externalVars | globalVars | accessVars"
BODY = "(IL | ST | FBD | LD | SFC) " + DATA

PLACED = "!localId:id height:number width:number globalId:text "
ORDERED = PLACED + "executionOrderId:id "
MARKS = "negated:flag edge:edge storage:storage "
VAR_LIST = ("variable* " + DATA, "name:text constant:flag retain:flag nonretain:flag persistent:flag nonpersistent:flag")
RANGE = ("", "!lower:text !upper:text")
PIN = "!formalParameter:text hidden:flag " + MARKS
BOX = ("position inputVariables inOutVariables outputVariables " + DATA)

# kind: (children in their order, attributes; `!`: required). A child is of the kind `parent/child`, else `child`.
KINDS = {
    "project": ("fileHeader contentHeader types instances " + DATA, ""),
    "fileHeader": ("", "!companyName:text companyURL:text !productName:text !productVersion:text productRelease:text "
                       "!creationDateTime:time contentDescription:text"),
    "contentHeader": ("Comment? coordinateInfo addDataInfo? addData?",
                      "!name:text version:text modificationDateTime:time organization:text author:text language:text"),
    "Comment": "text",
    "coordinateInfo": ("pageSize? fbd ld sfc", ""),
    "fbd": ("scaling", ""), "ld": ("scaling", ""), "sfc": ("scaling", ""),
    "scaling": ("", "!x:number !y:number"), "pageSize": ("", "!x:number !y:number"),
    "types": ("dataTypes pous", ""),
    "dataTypes": ("dataType*", ""),
    "dataType": ("baseType initialValue? " + DATA, "!name:text"),
    "pous": ("pou*", ""),
    "pou": ("interface? actions? transitions? body* " + DATA, "!name:text !pouType:pou globalId:text"),
    "interface": ("returnType? (" + LISTS + ")* " + DATA, ""),
    "actions": ("action*", ""), "transitions": ("transition*", ""),
    "actions/action": ("body " + DATA, "!name:text globalId:text"),
    "transitions/transition": ("body " + DATA, "!name:text globalId:text"),
    "body": (BODY, "WorksheetName:text globalId:text"),
    "action/inline": (BODY, "WorksheetName:text globalId:text"),
    "condition/inline": (BODY, "!name:text WorksheetName:text globalId:text"),
    "ST": "formatted", "IL": "formatted", "documentation": "formatted", "content": "formatted",
    "alternativeText": "formatted", "description": "formatted",
    "FBD": ("(" + FBD + ")*", ""), "LD": ("(" + LD + ")*", ""), "SFC": ("(" + SFC + ")*", ""),
    "instances": ("configurations", ""),
    "configurations": ("configuration*", ""),
    "configuration": ("resource* globalVars* accessVars? configVars? " + DATA, "!name:text globalId:text"),
    "resource": ("task* globalVars* pouInstance* " + DATA, "!name:text globalId:text"),
    "task": ("pouInstance* " + DATA, "!name:text single:text interval:text !priority:id globalId:text"),
    "pouInstance": (DATA, "!name:text !typeName:text globalId:text"),
    "configuration/accessVars": ("accessVariable* " + DATA, ""),
    "accessVariable": ("type " + DATA, "!alias:text !instancePathAndName:text direction:access"),
    "configVars": ("configVariable* " + DATA, ""),
    "configVariable": ("type initialValue? " + DATA, "!instancePathAndName:text address:text"),
    "variable": ("type initialValue? " + DATA, "!name:text address:text globalId:text"),
    "type": (A_TYPE, ""), "baseType": (A_TYPE, ""), "returnType": (A_TYPE, ""),
    "string": ("", "length:text"), "wstring": ("", "length:text"),
    "array": ("dimension dimension* baseType", ""), "dimension": RANGE, "range": RANGE,
    "derived": ("addData?", "!name:text"),
    "enum": ("values baseType?", ""), "values": ("value value*", ""), "values/value": ("", "!name:text value:text"),
    "struct": ("variable* " + DATA, ""),
    "subrangeSigned": ("range baseType", ""), "subrangeUnsigned": ("range baseType", ""),
    "pointer": ("baseType", ""),
    "initialValue": (A_VALUE, ""),
    "simpleValue": ("", "value:text"),
    "arrayValue": ("value*", ""), "arrayValue/value": (A_VALUE, "repetitionValue:text"),
    "structValue": ("value*", ""), "structValue/value": (A_VALUE, "!member:text"),
    "addData": ("data*", ""), "data": "foreign",
    "addDataInfo": ("info*", ""), "info": ("description?", "!name:text version:number !vendor:text"),
    "position": ("", "!x:number !y:number"), "relPosition": ("", "!x:number !y:number"),
    "connection": ("position* addData?", "globalId:text !refLocalId:id formalParameter:text"),
    "connectionPointIn": ("relPosition? (connection* | expression) addData?", "globalId:text"),
    "connectionPointOut": ("relPosition? expression? addData?", "globalId:text"),
    "connectionPointOutAction": ("relPosition? expression? addData?", "globalId:text !formalParameter:text"),
    "expression": "text",
    "comment": ("position content " + DATA, "!localId:id !height:number !width:number globalId:text"),
    "error": ("position content " + DATA, "!localId:id !height:number !width:number globalId:text"),
    "connector": ("position connectionPointIn? " + DATA, PLACED + "!name:text"),
    "continuation": ("position connectionPointOut? " + DATA, PLACED + "!name:text"),
    "actionBlock": ("position connectionPointIn? action* " + DATA, ORDERED + "negated:flag"),
    "actionBlock/action": ("relPosition reference? inline? connectionPointOut? " + DATA,
                           ORDERED + "qualifier:qualifier duration:text indicator:text"),
    "reference": ("", "!name:text"),
    "vendorElement": ("position alternativeText inputVariables? inOutVariables? outputVariables? addData documentation?",
                      ORDERED),
    "block": (BOX, ORDERED + "!typeName:text instanceName:text"),
    "inputVariables": ("variable*", ""), "inOutVariables": ("variable*", ""), "outputVariables": ("variable*", ""),
    "inputVariables/variable": ("connectionPointIn documentation?", PIN),
    "inOutVariables/variable": ("connectionPointIn? connectionPointOut? documentation?", PIN),
    "outputVariables/variable": ("connectionPointOut? documentation?", PIN),
    "inVariable": ("position connectionPointOut? expression " + DATA, ORDERED + MARKS),
    "outVariable": ("position connectionPointIn? expression " + DATA, ORDERED + MARKS),
    "inOutVariable": ("position connectionPointIn? connectionPointOut? expression " + DATA,
                      ORDERED + "negatedIn:flag edgeIn:edge storageIn:storage negatedOut:flag edgeOut:edge "
                                "storageOut:storage"),
    "label": ("position " + DATA, ORDERED + "!label:text"),
    "jump": ("position connectionPointIn? " + DATA, ORDERED + "!label:text"),
    "return": ("position connectionPointIn? " + DATA, ORDERED),
    "leftPowerRail": ("position connectionPointOut* " + DATA, ORDERED),
    "rightPowerRail": ("position connectionPointIn* " + DATA, ORDERED),
    "coil": ("position connectionPointIn? connectionPointOut? variable " + DATA, ORDERED + MARKS),
    "contact": ("position connectionPointIn? connectionPointOut? variable " + DATA, ORDERED + MARKS),
    "coil/variable": "text", "contact/variable": "text",
    "step": ("position connectionPointIn? connectionPointOut? connectionPointOutAction? " + DATA,
             ORDERED + "!name:text initialStep:flag negated:flag"),
    "macroStep": ("position connectionPointIn? connectionPointOut? body? " + DATA, ORDERED + "name:text"),
    "jumpStep": ("position connectionPointIn? " + DATA, ORDERED + "!targetName:text"),
    "transition": ("position connectionPointIn? connectionPointOut? condition? " + DATA, ORDERED + "priority:id"),
    "condition": ("(reference | connectionPointIn | inline)", "negated:flag"),
    "selectionDivergence": ("position connectionPointIn? connectionPointOut* " + DATA, PLACED),
    "selectionConvergence": ("position connectionPointIn* connectionPointOut? " + DATA, PLACED),
    "simultaneousDivergence": ("position connectionPointIn? connectionPointOut* " + DATA, PLACED + "name:text"),
    "simultaneousConvergence": ("position connectionPointIn* connectionPointOut? " + DATA, PLACED),
}
for name in ELEMENTARY:
    KINDS[name] = ("", "")
for name in LISTS.split(" | "):
    KINDS[name] = VAR_LIST
# Outputs of these have a name.
for name in ("leftPowerRail", "step", "selectionDivergence", "simultaneousDivergence"):
    KINDS[name + "/connectionPointOut"] = (KINDS["connectionPointOut"][0], "globalId:text !formalParameter:text")

models = {}


def model(children):
    """The children of a kind as a regular expression over `name_name_`."""
    if children not in models:
        text = re.sub(r"[A-Za-z_]+", lambda m: "(?:" + m[0] + "_)", children)
        models[children] = re.compile(text.replace(" ", ""))
    return models[children]


class Checker:
    def __init__(self, path):
        self.path, self.count = path, 0

    def wrong(self, where, text):
        self.count += 1
        print(f"{self.path}: {where}: {text}")

    def element(self, e, kind, where):
        rule = KINDS[kind]
        if rule == "foreign":
            return self.data(e, where)
        if rule == "text":
            if len(e) or e.attrib:
                self.wrong(where, "holds more than text")
            return
        if rule == "formatted":
            if len(e) != 1 or not e[0].tag.startswith(XHTML) or (e.text or "").strip() or (e[0].tail or "").strip():
                self.wrong(where, "does not hold one element of XHTML")
            return
        children, attributes = rule
        self.attributes(e, attributes, where)
        if (e.text or "").strip() or any((c.tail or "").strip() for c in e):
            self.wrong(where, "text stands between its elements")
        names = []
        for child in e:
            if not child.tag.startswith(TC6):
                return self.wrong(where, f"{child.tag} is no element of TC6")
            names.append(child.tag[len(TC6):])
        if not model(children).fullmatch("".join(name + "_" for name in names)):
            return self.wrong(where, f"holds [{' '.join(names)}], not [{children}]")
        parent = kind.split("/")[-1]
        for child, name in zip(e, names):
            own = parent + "/" + name
            self.element(child, own if own in KINDS else name, where + "/" + (child.get("name") or name))
        if kind in ("FBD", "LD", "SFC"):
            self.wires(e, where)

    def attributes(self, e, attributes, where):
        known = dict(a.split(":") for a in attributes.split())
        for name in list(known):
            if name.startswith("!"):
                known[name[1:]] = known.pop(name)
                if name[1:] not in e.attrib:
                    self.wrong(where, f"needs the attribute {name[1:]}")
        for name, value in e.attrib.items():
            if name not in known:
                self.wrong(where, f"has no attribute {name}")
            elif not FORMS[known[name]].fullmatch(value):
                self.wrong(where, f'{name}="{value}" is no {known[name]}')

    def data(self, e, where):
        self.attributes(e, "!name:text !handleUnknown:unknown", where)
        if len(e) != 1:
            self.wrong(where, "holds not one element")
        for body in e.iter(TC6 + "body"):  # of methods: by the same rules
            self.element(body, "body", where + "/body")

    def wires(self, body, where):
        ids = [e.get("localId") for e in body.iter() if e.get("localId") is not None and e.tag != TC6 + "action"]
        for twice in {i for i in ids if ids.count(i) > 1} if len(ids) < 2000 else set():
            self.wrong(where, f"duplicate localId {twice}")
        known = set(ids)
        for wire in body.iter(TC6 + "connection"):
            if wire.get("refLocalId") not in known:
                self.wrong(where, f"a wire comes from {wire.get('refLocalId')}, which nothing is")


def main():
    wrong = 0
    for path in sys.argv[1:]:
        checker = Checker(path)
        try:
            root = ET.parse(path).getroot()
        except ET.ParseError as error:
            checker.wrong("", str(error))
        else:
            if root.tag == TC6 + "project":
                checker.element(root, "project", "project")
            else:
                checker.wrong("", f"the root is {root.tag}")
        wrong += checker.count
    sys.exit(1 if wrong else 0)


main()
