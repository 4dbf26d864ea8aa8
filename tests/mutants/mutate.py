"""Writes every mutant of a C++ source into one copy of it, from which the environment picks one.

A call of mutant.hpp takes the place of each operator, number, condition and statement in the bodies
of functions. What has to be constant stays: constexpr functions and variables, labels, templates'
arguments and static_assert.
"""
import bisect
import dataclasses

from clang import cindex
from clang.cindex import CursorKind as Kind

COMPARISONS = {'<': ('less', '<=', '>='), '<=': ('less_equal', '<', '>'), '>': ('greater', '>=', '<='),
               '>=': ('greater_equal', '>', '<')}
OPERATORS = {'+': ('plus', '-'), '-': ('minus', '+'), '*': ('times', '/'), '/': ('over', '*'), '%': ('modulo', '*'),
             '&': ('bit_and', '|'), '|': ('bit_or', '&'), '^': ('bit_xor', '&'), '<<': ('left_shift', '>>'),
             '>>': ('right_shift', '<<'), '==': ('equal', '!='), '!=': ('unequal', '==')}
JOINED = {'&&': ('both', '||'), '||': ('either', '&&')}
COMPOUND = {'+=': '-=', '-=': '+=', '*=': '/=', '/=': '*=', '|=': '&=', '&=': '|=', '^=': '&=', '<<=': '>>=', '>>=': '<<='}
OVERLOADED = {'operator' + text for text in (*COMPARISONS, *OPERATORS, *COMPOUND)}
FUNCTIONS = (Kind.CXX_METHOD, Kind.FUNCTION_DECL, Kind.CONSTRUCTOR, Kind.DESTRUCTOR)
STATEMENTS = (Kind.CALL_EXPR, Kind.BINARY_OPERATOR, Kind.COMPOUND_ASSIGNMENT_OPERATOR, Kind.UNARY_OPERATOR)
HOLDERS = (Kind.COMPOUND_STMT, Kind.IF_STMT, Kind.FOR_STMT, Kind.WHILE_STMT, Kind.CXX_FOR_RANGE_STMT, Kind.CASE_STMT,
           Kind.DEFAULT_STMT)


@dataclasses.dataclass
class Mutant:
    number: int
    file: str
    line: int
    code: str      # the line of the source
    change: str    # what is done to which part of it


class Mutator:
    def __init__(self, path, name, arguments, first_number, refused=()):
        """`refused`: lines whose mutants did not compile."""
        self.source = open(path, 'rb').read()
        self.name = name
        self.next_number = first_number
        self.mutants = []
        self.refused = set(refused)
        lines = self.source.split(b'\n')
        self.lines = [line.decode() for line in lines]
        self.starts = [0]
        for line in lines:
            self.starts.append(self.starts[-1] + len(line) + 1)
        self.unit = cindex.Index.create().parse(path, args=arguments)
        errors = [str(d) for d in self.unit.diagnostics if d.severity >= 3]
        if errors:
            raise SystemExit(f'{path} does not parse: {errors[0]}')

    def text(self):
        out, at = [], 0
        for function in self.functions(self.unit.cursor):
            body = [c for c in function.get_children() if c.kind == Kind.COMPOUND_STMT]
            if not body:
                continue
            start, end = self.extent(body[-1])
            out += [self.raw(at, start), self.render(body[-1], None)]
            at = end
        return ''.join(out) + self.raw(at, len(self.source))

    def functions(self, cursor):
        for child in cursor.get_children():
            if child.location.file is None or child.location.file.name != self.unit.spelling:
                continue
            if child.kind in FUNCTIONS:
                head = [t.spelling for t in child.get_tokens()]
                head = head[:head.index('{')] if '{' in head else head
                if child.is_definition() and not {'constexpr', 'consteval'} & set(head):
                    yield child
            elif child.kind in (Kind.NAMESPACE, Kind.CLASS_DECL, Kind.STRUCT_DECL):
                yield from self.functions(child)

    def extent(self, cursor):
        return cursor.extent.start.offset, cursor.extent.end.offset

    def raw(self, start, end):
        return self.source[start:end].decode()

    def add(self, cursor, change):
        """Notes a mutant and returns its number, or nothing where the line refuses mutants."""
        line = bisect.bisect_right(self.starts, cursor.extent.start.offset)
        if line in self.refused:
            return None
        number, self.next_number = self.next_number, self.next_number + 1
        self.mutants.append(Mutant(number, self.name, line, self.lines[line - 1].strip(), change))
        return number

    def render(self, cursor, parent):
        """The text of a cursor with its mutants."""
        if cursor.kind in (Kind.STATIC_ASSERT, Kind.TYPE_REF, Kind.TEMPLATE_REF, Kind.STRING_LITERAL):
            return self.raw(*self.extent(cursor))
        if cursor.kind == Kind.VAR_DECL and 'constexpr' in [t.spelling for t in cursor.get_tokens()]:
            return self.raw(*self.extent(cursor))
        text = self.own_mutants(cursor)
        if parent is not None and self.is_statement(cursor, parent):
            number = self.add(cursor, f'"{self.brief(cursor)}" left out')
            if number:
                text = f'(plumb_mutant::on({number}) ? void() : void({text}))'
        if parent is not None and self.is_condition(cursor, parent):
            number = self.add(cursor, f'"{self.brief(cursor)}" never')
            if number:
                text = f'(!plumb_mutant::on({number}) && ({text}))'
        return text

    def brief(self, cursor):
        text = ' '.join(self.raw(*self.extent(cursor)).split())
        return text if len(text) <= 60 else text[:57] + '...'

    def is_statement(self, cursor, parent):
        if parent.kind not in HOLDERS or cursor.kind not in STATEMENTS:
            return False
        rest = self.source[cursor.extent.end.offset:].lstrip()
        return rest[:1] == b';' and not self.is_head(cursor, parent)

    def is_head(self, cursor, parent):
        """Whether the cursor stands between the brackets of if, for or while."""
        if parent.kind in (Kind.COMPOUND_STMT, Kind.CASE_STMT, Kind.DEFAULT_STMT):
            return False
        before = self.raw(parent.extent.start.offset, cursor.extent.start.offset)
        return before.count('(') > before.count(')')

    def is_condition(self, cursor, parent):
        return (parent.kind == Kind.IF_STMT and self.is_head(cursor, parent) and cursor.kind != Kind.DECL_STMT
                and cursor.kind != Kind.VAR_DECL and self.source[cursor.extent.end.offset:].lstrip()[:1] == b')')

    def children_text(self, cursor, start, end):
        out, at = [], start
        for child in sorted(cursor.get_children(), key=self.extent):
            first, last = self.extent(child)
            # An operator whose sides C++20 exchanged ends before it begins.
            if first < at or last > end or first >= last:
                continue
            if cursor.kind == Kind.CASE_STMT and at == start:
                out.append(self.raw(at, last))  # the label
            else:
                out += [self.raw(at, first), self.render(child, cursor)]
            at = last
        return ''.join(out) + self.raw(at, end)

    def own_mutants(self, cursor):
        start, end = self.extent(cursor)
        if cursor.kind in (Kind.BINARY_OPERATOR, Kind.COMPOUND_ASSIGNMENT_OPERATOR):
            return self.binary(cursor, start, end)
        if cursor.kind == Kind.CALL_EXPR and cursor.spelling in OVERLOADED:
            return self.overloaded(cursor, start, end)
        text = self.children_text(cursor, start, end)
        if cursor.kind in (Kind.INTEGER_LITERAL, Kind.FLOATING_LITERAL):
            number = self.add(cursor, f'{text} + 1')
            return f'plumb_mutant::number({number}, {text})' if number else text
        if cursor.kind == Kind.CXX_BOOL_LITERAL_EXPR or (
                cursor.kind == Kind.UNARY_OPERATOR and self.raw(start, start + 1) == '!' and
                self.raw(start, start + 2) != '!='):
            number = self.add(cursor, f'not {self.brief(cursor)}')
            return f'plumb_mutant::flip({number}, static_cast<bool>({text}))' if number else text
        return text

    def overloaded(self, cursor, start, end):
        """An operator of a class: only a comparison has a mutant, and nothing inside."""
        text = self.raw(start, end)
        if cursor.spelling not in ('operator==', 'operator!='):
            return text
        number = self.add(cursor, f'not {self.brief(cursor)}')
        return f'plumb_mutant::flip({number}, static_cast<bool>({text}))' if number else text

    def binary(self, cursor, start, end):
        sides = list(cursor.get_children())
        left, right = self.extent(sides[0]), self.extent(sides[1])
        if len(sides) != 2 or not start == left[0] <= left[1] <= right[0] <= right[1] == end:
            return self.children_text(cursor, start, end)
        operator = self.raw(left[1], right[0]).strip()
        a, b = self.render(sides[0], cursor), self.render(sides[1], cursor)
        plain = f'{a}{self.raw(left[1], right[0])}{b}'
        what = self.brief(cursor)
        if operator in COMPARISONS:
            name, shifted, turned = COMPARISONS[operator]
            number = self.add(cursor, f'"{what}" with {shifted}')
            return f'plumb_mutant::{name}({number}, {a}, {b})' if number and self.add(
                cursor, f'"{what}" with {turned}') else plain
        if operator in OPERATORS:
            name, instead = OPERATORS[operator]
            number = self.add(cursor, f'"{what}" with {instead}')
            return f'plumb_mutant::{name}({number}, {a}, {b})' if number else plain
        if operator in JOINED:
            name, instead = JOINED[operator]
            number = self.add(cursor, f'"{what}" with {instead}')
            return (f'plumb_mutant::{name}({number}, static_cast<bool>({a}), [&] {{ return static_cast<bool>({b}); }})'
                    if number else plain)
        if operator in COMPOUND:
            number = self.add(cursor, f'"{what}" with {COMPOUND[operator]}')
            return f'(plumb_mutant::on({number}) ? ({a} {COMPOUND[operator]} {b}) : ({plain}))' if number else plain
        return plain
