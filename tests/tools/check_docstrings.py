# Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
# SPDX-License-Identifier: Apache-2.0
"""Reads the public headers: those of the library, without *_internal.h. Refuses a function without a docstring, a
pointer to numbers without a shape, a double without a unit, a status without a list of what is returned. Struct members
are held to the same rule by their comments."""

import re
import sys

import source

SYMBOL = r"(?:[kMGmnu]?(?:m|s|g|Pa|N|J|W|Hz)|K|rad|deg(?:rees?)?|pixels?|bytes?|1)(?:\^?-?\d)?"
EXPRESSION = rf"{SYMBOL}(?:(?:/| |\*| \* | per ){SYMBOL})*"
REFERENCE = r"\blikewise\b|\bas (?:in )?\w+_\w+"  # to something that is described
UNIT = re.compile(rf"\b[Uu]nits?\b|\bSI\b|\[{SYMBOL}(?:[/*^ ][^\]]*)?\]|{REFERENCE}"
                  rf"|(?:^|[,;:(]|\bin|\bis) *{EXPRESSION}(?= *(?:$|[,;.:)=<>]| in | for ))")
SHAPE = re.compile(rf"\bshapes? \[|\bone (?!of\b)\w|zero-terminated|static string|\baddress of|\bended by|\bopen file"
                   rf"|{REFERENCE}")
DIRECTION = re.compile(r"\[(in|out|in,out|in, out)\]")
KEYWORD = re.compile(r"\b(Theory|Needs|Gives|Returns|Cost|Threads):")


class Parameter:
    """One parameter or struct member: name, type without qualifiers, pointer or array."""

    def __init__(self, text):
        text = re.sub(r"\b(const|restrict|volatile|static|struct|register)\b", " ", text)
        array = "[" in text
        text = re.sub(r"\[[^\]]*\]", " ", text)
        words = re.findall(r"\w+", text)
        self.name = words[-1] if len(words) > 1 else ""
        self.type = " ".join(words[:-1]) if len(words) > 1 else " ".join(words)
        self.is_pointer = "*" in text
        self.stars = text.count("*")
        self.is_array = array
        self.is_opaque = self.is_pointer and self.type in ("void", "FILE") and text.count("*") == 1
        self.is_number = re.fullmatch(r"double|float|int|u?int\d+_t|size_t|bool|unsigned( char)?|char", self.type)

    @property
    def is_object(self):
        """One object: its type says all that there is to say."""
        return not self.is_number and not self.is_array and self.stars == 1

    @property
    def is_real(self):
        return self.type in ("double", "float")


def clean(comment):
    """The words of a comment on one line, without stars."""
    return re.sub(r"\s+", " ", re.sub(r"(?m)^[ \t]*\*+", " ", comment.strip("/*"))).strip()


def split_parameters(text):
    parts, depth, last = [], 0, 0
    for match in re.finditer(r"[(),]", text):
        depth += {"(": 1, ")": -1}.get(match.group(0), 0)
        if match.group(0) == "," and depth == 0:
            parts.append(text[last:match.start()])
            last = match.end()
    parts.append(text[last:])
    return [part.strip() for part in parts if part.strip() not in ("", "void", "...")]


def parse_declarator(head):
    """(return type, name, parameters) of a function, a function type or a function pointer; None for anything else."""
    head = re.sub(r"__attribute__\s*\(\((?:[^()]|\([^()]*\))*\)\)", " ", head)
    head = re.sub(r"\b(static|inline|extern|typedef|_Noreturn)\b", " ", head)
    match = re.match(r"\s*([\w\s*]*?)\(\s*\*\s*(?:const\s+)?(\w+)\s*\)\s*\((.*)\)\s*$", head, re.DOTALL) or re.match(
        r"\s*([\w\s*]*?[\s*])(\w+)\s*\((.*)\)\s*$", head, re.DOTALL)
    if match is None:
        return None
    return match.group(1).strip(), match.group(2), [Parameter(part) for part in split_parameters(match.group(3))]


def parameter_texts(docstring):
    """Name -> what is said about it, from the @param entries."""
    texts = {}
    for entry in re.split(r"@param\b", docstring)[1:]:
        entry = KEYWORD.split(entry)[0].strip()
        names = re.match(r"[\w, ]*?\w+(?= *[\[ ]|$)", entry)
        head = entry.split("[", 1)[0] if DIRECTION.search(entry) else (names.group(0).split()[0] if names else "")
        for name in re.findall(r"\w+", head):
            texts[name] = DIRECTION.sub(" ", entry[len(head):], count=1).strip()
    return texts


def check_parameter(parameter, text):
    if parameter.is_opaque:
        return None
    if parameter.is_pointer or parameter.is_array:
        if parameter.is_object:
            return None
        if not SHAPE.search(text):
            return "no shape; say shape [n,3], one object, zero-terminated, or the like"
    if parameter.is_real and not UNIT.search(text):
        return "no unit; say unit m, [m/s], 1 for a pure number, or the like"
    return None


def check_function(head, docstring):
    """Problems of one declaration, each without its place."""
    parsed = parse_declarator(head)
    if parsed is None:
        return
    result, name, parameters = parsed
    if docstring is None:
        needs_none = not any(one.is_real or (one.is_pointer and one.is_number) for one in parameters)
        if not (needs_none and re.search(r"\(\s*\*", head)):  # a type of function may be described by its user
            yield f"{name} has no docstring; say what it does, shapes, units and what it returns"
        return
    listed = parameter_texts(docstring)
    for parameter in parameters:
        if listed and parameter.name not in listed:
            if not parameter.is_opaque and not parameter.is_object:
                yield f"{name}: parameter {parameter.name} is not described"
            continue
        problem = check_parameter(parameter, listed.get(parameter.name, docstring))
        if problem:
            yield f"{name}: parameter {parameter.name} has {problem}"
    if re.fullmatch(r"(const )?(double|float)", result) and not UNIT.search(docstring):
        yield f"{name}: what it returns has no unit; say unit m, [m/s], 1 for a pure number, or the like"
    if result == "mor_status" and listed and "Returns" not in docstring:
        yield f"{name}: no 'Returns:'; list each status and when it is returned"


def comment_before(text, offset):
    """The comment that ends right before an offset, or None."""
    before = text[:offset].rstrip()
    if not before.endswith("*/"):
        return None
    return clean(before[before.rindex("/*"):])


def comment_after(text, offset):
    match = re.match(r"[ \t]*/\*.*?\*/", text[offset:], re.DOTALL)
    return clean(match.group(0).strip()) if match else None


def check_members(text, code, begin, end, docstring):
    """Problems (offset, message) of the members of a struct whose body lies between two offsets. A unit may be stated
    once for all members in the docstring of the struct."""
    start = begin
    for match in re.finditer(r"[;{}]", code[begin:end]):
        offset = begin + match.start()
        member = code[start:offset]
        first = start + len(member) - len(member.lstrip())
        start = offset + 1
        if match.group(0) != ";" or not member.strip():
            continue
        comment = comment_after(text, offset + 1)
        documented = comment or comment_before(text, first)
        if "(" in member:
            yield from ((first, problem) for problem in check_function(member, documented))
            continue
        kind = re.match(r"\s*((?:const |struct |unsigned )*\w+)", member).group(1)
        for part in split_parameters(member[len(kind) + len(member) - len(member.lstrip()):]):
            parameter = Parameter(f"{kind} {part}")
            if parameter.is_pointer and parameter.is_number and parameter.type != "char":
                if not SHAPE.search(documented or ""):
                    yield first, f"member {parameter.name} has no shape; say shape [n,3] or the like in its comment"
            if parameter.is_real and not UNIT.search(documented or "") and not UNIT.search(docstring):
                yield first, f"member {parameter.name} has no unit; say it in its comment, 1 for a pure number"


def check_header(text):
    """Problems (offset, message) of one header."""
    code = source.code_only(text)
    depth, begin, opened = 0, 0, 0
    for match in re.finditer(r"[{};]", code):
        sign, offset = match.group(0), match.start()
        if sign == "{":
            opened = offset if depth == 0 else opened
            depth += 1
            continue
        depth -= sign == "}"
        if depth != 0:
            continue
        head = code[begin:opened if sign == "}" else offset]
        first = begin + len(head) - len(head.lstrip())
        if sign == "}" and re.match(r"\s*(typedef\s+)?(struct|union)\b[^()=]*$", head):
            yield from check_members(text, code, opened + 1, offset, comment_before(text, first) or "")
        elif sign == "}" or "{" not in head:
            is_function = "(" in head and "=" not in head.split("(")[0] and not head.lstrip().startswith("}")
            if is_function:
                yield from ((first, problem) for problem in check_function(head, comment_before(text, first)))
        begin = offset + 1


def check(root):
    problems = []
    for path in source.list_files(root, (".h",)):
        if path.startswith(("tests/", "cases/driver/")) or path.endswith("_internal.h"):
            continue
        text = source.read_text(root, path)
        problems.extend(f"{path}:{source.line_of(text, offset)}: {problem}" for offset, problem in check_header(text))
    return problems


if __name__ == "__main__":
    sys.exit(source.report("Docstrings that leave a reader guessing", check(source.parse_root().root),
                           "The order is: what changes, theory, parameters, needs, gives, returns, cost."))
