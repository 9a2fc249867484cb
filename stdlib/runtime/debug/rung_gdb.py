# SPDX-License-Identifier: Apache-2.0
"""Shows the variables of a program that `rung build -g` made by their names, types and values in ST, in gdb.
gdb loads it with the program (docs/debugging.md), or by `source PROGRAM-gdb.py`. It reads the tables of rung/module.h that every
compiled project has, so it needs nothing else of the build."""
import datetime
import re
import struct

import gdb
import gdb.printing
from gdb.FrameDecorator import FrameDecorator

KINDS = ('BOOL BYTE WORD DWORD LWORD SINT INT DINT LINT USINT UINT UDINT ULINT REAL LREAL TIME LTIME DATE LDATE TOD LTOD DT LDT '
         'CHAR WCHAR UCHAR STRING WSTRING USTRING ENUM ARRAY RECORD POINTER').split()
BY_REFERENCE, BASE, BIT, BIT_SHIFT = 1, 64, 0xf00, 8  # rung_field_flags
MOST_ELEMENTS = 200


def mangled(name):
    """The names of generated code (codegen/names.h)."""
    if re.fullmatch(r'[A-Za-z][A-Za-z0-9_]*', name):
        return name + '_'
    return 'u' + ''.join(c if c.isascii() and c.isalnum() else '__' if c == '_' else
                         ''.join('_x%02x' % byte for byte in c.encode()) for c in name) + '0u'


class Tables:
    """The description of one module: `plc_::types` and its neighbours."""
    known = {}

    @classmethod
    def of(cls, space):
        if space not in cls.known:
            try:
                cls.known[space] = cls(space)
            except gdb.error:
                return None  # not a module, or no debug information
        return cls.known[space]

    def __init__(self, space):
        def table(name):
            return gdb.parse_and_eval("'%s::%s'" % (space, name))

        def rows(name):
            try:
                value = table(name)
            except gdb.error:
                return []  # an empty table is not there
            return [value[i] for i in range(value.type.range()[1] + 1)]
        text = table('text')
        self.text = bytes(int(text[i]) & 255 for i in range(text.type.range()[1] + 1))
        self.types = [{field.name: int(row[field.name]) for field in row.type.fields()} for row in rows('types')]
        self.fields = [tuple(int(row[name]) for name in ('name', 'type', 'offset', 'flags')) for row in rows('fields')]
        self.items = [(int(row['name']), int(row['value'])) for row in rows('enum_items')]
        self.dimensions = [(int(row['low']), int(row['high'])) for row in rows('dimensions')]
        self.symbols = [{field.name: int(row[field.name]) for field in row.type.fields()} for row in rows('symbols')]
        self.records = {}
        for index, row in enumerate(self.types):
            if KINDS[row['kind']] == 'RECORD':
                self.records.setdefault(mangled(self.string(row['name'])).rstrip('_') + '_type', index)

    def string(self, offset):
        return self.text[offset:self.text.index(b'\0', offset)].decode('utf-8', 'replace')


def memory(address, size):
    return bytes(gdb.selected_inferior().read_memory(address, size))


def quoted(text, mark):
    names = {'\n': '$L', '\r': '$R', '\t': '$T', '\f': '$P', '$': '$$', mark: '$' + mark}
    return mark + ''.join(names.get(c, c if c.isprintable() else '$%02X' % ord(c)) for c in text) + mark


def real(raw):
    """The shortest decimal that is this number."""
    form = '<f' if len(raw) == 4 else '<d'
    number = struct.unpack(form, raw)[0]
    text = next((t for t in ('%.*g' % (digits, number) for digits in range(1, 18)) if struct.pack(form, float(t)) == raw),
                str(number))
    return text if re.search('[.en]', text) else text + '.0'


def duration(nanoseconds, prefix):
    sign, rest, parts = '-' if nanoseconds < 0 else '', abs(nanoseconds), []
    for unit, size in (('d', 86400 * 10**9), ('h', 3600 * 10**9), ('m', 60 * 10**9), ('s', 10**9), ('ms', 10**6),
                       ('us', 1000), ('ns', 1)):
        if rest >= size:
            parts.append('%d%s' % (rest // size, unit))
            rest %= size
    return prefix + '#' + sign + (''.join(parts) or ('0ms' if prefix == 'T' else '0ns'))


def clock(nanoseconds, prefix):
    seconds, rest = divmod(nanoseconds, 10**9)
    text = '%02d:%02d:%02d' % (seconds // 3600, seconds // 60 % 60, seconds % 60)
    return '%s#%s%s' % (prefix, text, ('.%09d' % rest).rstrip('0') if rest else '')


def moment(nanoseconds, prefix, with_clock):
    seconds, rest = divmod(nanoseconds, 10**9)
    at = datetime.datetime(1970, 1, 1) + datetime.timedelta(seconds=seconds)
    text = at.strftime('%Y-%m-%d-%H:%M:%S' if with_clock else '%Y-%m-%d')
    return '%s#%s%s' % (prefix, text, ('.%09d' % rest).rstrip('0') if rest and with_clock else '')


def elementary(tables, row, address, bit=None):
    """The value of what is no array and no record, as a trace prints it."""
    kind, size = KINDS[row['kind']], row['size']
    if bit is not None:
        return 'TRUE' if memory(address, 1)[0] >> bit & 1 else 'FALSE'
    raw = memory(address, size)
    number = int.from_bytes(raw, 'little', signed=bool(row['is_signed']))
    if kind == 'BOOL':
        return 'TRUE' if number else 'FALSE'
    if kind in ('REAL', 'LREAL'):
        return real(raw)
    if kind == 'TIME':
        return duration(number * 10**6, 'T')
    if kind == 'LTIME':
        return duration(number, 'LTIME')
    if kind in ('DATE', 'LDATE'):
        return moment(number * (10**9 if kind == 'DATE' else 1), 'D' if kind == 'DATE' else 'LDATE', False)
    if kind in ('TOD', 'LTOD'):
        return clock(number * (10**6 if kind == 'TOD' else 1), kind)
    if kind in ('DT', 'LDT'):
        return moment(number * (10**9 if kind == 'DT' else 1), kind, True)
    if kind in ('STRING', 'USTRING'):
        return quoted(raw.split(b'\0')[0].decode('utf-8' if kind == 'USTRING' else 'latin-1', 'replace'), "'")
    if kind == 'WSTRING':
        return quoted(raw.decode('utf-16-le', 'replace').split('\0')[0], '"')
    if kind in ('CHAR', 'WCHAR', 'UCHAR'):
        return quoted(chr(number & 0x1fffff), "'" if kind == 'CHAR' else '"')
    if kind == 'ENUM':
        for name, value in tables.items[row['first']:row['first'] + row['count']]:
            if value == number:
                return tables.string(name)
        return str(number)
    if kind == 'POINTER':
        return '16#%X' % number if number else 'NULL'
    return str(number)


def value_of(tables, index, address, bit=None):
    """A string, or a printer with children."""
    row = tables.types[index]
    kind = KINDS[row['kind']]
    if kind in ('RECORD', 'ARRAY'):
        return Part(tables, index, address)
    return elementary(tables, row, address, bit)


def text_of(tables, index, address, bit=None):
    """On one line, for the children of gdb's own printing."""
    value = value_of(tables, index, address, bit)
    if isinstance(value, str):
        return value
    inner = list(value.parts())
    if KINDS[tables.types[index]['kind']] == 'ARRAY':
        return '[' + ', '.join(text_of(tables, *part[1:]) for part in inner) + ']'
    return '(' + ', '.join('%s := %s' % (part[0], text_of(tables, *part[1:])) for part in inner) + ')'


class Part:
    """A record or an array at an address."""

    def __init__(self, tables, index, address):
        self.tables, self.row, self.address = tables, tables.types[index], address

    def parts(self):
        """(name, type, address, bit) of each."""
        if KINDS[self.row['kind']] == 'RECORD':
            for name, index, offset, flags in self.tables.fields[self.row['first']:self.row['first'] + self.row['count']]:
                place = self.address + offset
                if flags & BASE:
                    yield from Part(self.tables, index, place).parts()
                    continue
                if flags & BY_REFERENCE:
                    place = int.from_bytes(memory(place, gdb.lookup_type('void').pointer().sizeof), 'little')
                yield self.tables.string(name), index, place, (flags >> BIT_SHIFT & 15) - 1 if flags & BIT else None
            return
        dimensions = self.tables.dimensions[self.row['first']:self.row['first'] + self.row['count']]
        size = self.tables.types[self.row['element']]['size']
        total = 1
        for low, high in dimensions:
            total *= high - low + 1
        for number in range(min(total, MOST_ELEMENTS)):
            indices, rest = [], number
            for low, high in reversed(dimensions):
                rest, index = divmod(rest, high - low + 1)
                indices.insert(0, str(low + index))
            yield '[' + ','.join(indices) + ']', self.row['element'], self.address + number * size, None


class RecordPrinter:
    """For gdb's print: the struct of a program, block or structure."""

    def __init__(self, tables, index, value):
        self.tables, self.index, self.address = tables, index, int(value.address)

    def to_string(self):
        return self.tables.string(self.tables.types[self.index]['name']) + ' ' + text_of(self.tables, self.index, self.address)


def find_printer(value):
    kind = value.type.strip_typedefs().unqualified()
    match = re.fullmatch(r'(\w+)::(\w+_type)', str(kind.tag or kind.name or ''))
    if kind.code not in (gdb.TYPE_CODE_STRUCT, gdb.TYPE_CODE_UNION) or not match or value.address is None:
        return None
    tables = Tables.of(match.group(1))
    index = tables.records.get(match.group(2)) if tables else None
    return None if index is None else RecordPrinter(tables, index, value)


def space_of(frame):
    """The namespace of the module whose code a frame runs."""
    match = re.match(r'(\w+_)::', frame.name() or '')
    return match.group(1) if match and Tables.of(match.group(1)) else None


class PouFrame(FrameDecorator):
    """A frame of generated code has the name of its POU, and no arguments of C++."""

    def __init__(self, frame):
        FrameDecorator.__init__(self, frame)
        inner = self.inferior_frame()
        match = re.match(r'\w+_::(\w+?)_(?:body|fn|init)\b', inner.name() or '')
        self.pou = match.group(1) if match and space_of(inner) else None

    def function(self):
        return self.pou or FrameDecorator.function(self)

    def address(self):
        return None if self.pou else FrameDecorator.address(self)

    def frame_args(self):
        return None if self.pou else FrameDecorator.frame_args(self)


class PouFrames:
    name, enabled, priority = 'rung', True, 100

    def filter(self, frames):
        return (PouFrame(frame) for frame in frames)


class StCommand(gdb.Command):
    """st [PATH]: a variable of the program by its path in ST, such as Main.pump.level; without a path, what there is.
It works where gdb has stopped in a body of the program, or in what such a body has called."""

    def __init__(self):
        gdb.Command.__init__(self, 'st', gdb.COMMAND_DATA)

    def roots(self):
        try:
            frame = gdb.selected_frame()
        except gdb.error:
            frame = None  # nothing runs
        while frame is not None:
            space = space_of(frame)
            if space:
                try:
                    return Tables.of(space), frame.read_var('ctx')
                except ValueError:
                    pass
            frame = frame.older()
        raise gdb.GdbError('no body of the program is running here')

    def invoke(self, argument, from_tty):
        tables, context = self.roots()
        wanted = argument.strip().lower()
        found = None
        for symbol in tables.symbols:
            name = tables.string(symbol['name'])
            if not wanted:
                print(name)
            elif (wanted + '.').startswith(name.lower() + '.') or wanted.startswith(name.lower() + '['):
                if found is None or len(name) > len(found[0]):
                    found = name, symbol
        if not wanted:
            return
        if found is None:
            raise gdb.GdbError('`%s` is not a variable of the program; `st` alone lists the first names' % argument.strip())
        name, symbol = found
        in_area = symbol['storage'] == 1
        base = int(context['areas' if in_area else 'blocks'][symbol['index']])
        place = symbol['type'], base + symbol['offset'], symbol['bit'] if symbol['bit'] != 255 else None
        shown = name
        for step in re.findall(r'\.?(\w+)|\[([^\]]*)\]', wanted[len(name):]):
            value = value_of(tables, *place)
            if isinstance(value, str):
                raise gdb.GdbError('`%s` has no parts' % shown)
            label = step[0] or '[' + step[1].replace(' ', '') + ']'
            for part in value.parts():
                if part[0].lower() == label:
                    place, shown = part[1:], shown + ('' if label[0] == '[' else '.') + part[0]
                    break
            else:
                raise gdb.GdbError('`%s` has no `%s`' % (shown, label))
        print('%s = %s' % (shown, text_of(tables, *place)))


def register(objfile):
    printer = gdb.printing.PrettyPrinter('rung')
    printer.__class__ = type('RungPrinter', (gdb.printing.PrettyPrinter,), {'__call__': lambda self, value: find_printer(value)})
    gdb.printing.register_pretty_printer(objfile, printer, replace=True)
    (objfile or gdb).frame_filters['rung'] = PouFrames()
    StCommand()


register(gdb.current_objfile())
