"""Writes ibr/_records.pyi, the types of all results, from docs/json.md: `python python/records.py`. A test compares the two."""

import keyword
import re
from pathlib import Path

HERE = Path(__file__).resolve().parent
WRITTEN = HERE / "ibr/_records.pyi"

# Answers that are results in Python, and their keys that have a property of the same name there.
ANSWERS = {
    "ibr.add": ("AddKeys", {"warnings"}),
    "ibr.characterize": ("CharacterizeKeys", {"warnings"}),
    "ibr.compare": ("CompareKeys", {"warnings"}),
    "ibr.design": ("DesignKeys", {"scenario"}),
    "ibr.diagnose": ("DiagnoseKeys", {"warnings"}),
    "ibr.ladder": ("LadderKeys", {"warnings"}),
    "ibr.pattern": ("PatternKeys", set()),
    "ibr.simulate": ("SimulateKeys", {"folder", "warnings"}),
    "ibr.validate": ("ValidateKeys", set()),
}
ALSO = ["Actuator", "Effect", "NamedText", "PredictedState", "SetInfo"]

HEAD = '''"""Keys of the results: a dictionary with its keys for every record of docs/json.md. Made by python/records.py."""

import typing as t

import typing_extensions as x

'''


def parsed(text):
    """Key, type and meaning of every row, by heading."""
    found = {}
    for part in re.split(r"^### ", text, flags=re.MULTILINE)[1:]:
        head, *lines = part.splitlines()
        rows = [line.strip("|").split("|") for line in lines if line.startswith("| ")]
        found[head.split()[0]] = [[cell.strip() for cell in row] for row in rows if row[1].strip() != "type"]
    return found


def typed(kind):
    """A type of docs/json.md in Python."""
    if " or " in kind:
        return f"t.Union[{', '.join(typed(part) for part in kind.split(' or '))}]"
    if kind.startswith("map of "):
        return f"t.Dict[str, {typed(kind[7:])}]"
    if kind.endswith("?"):
        return f"t.Optional[{typed(kind[:-1])}]"
    if kind.endswith("[]"):
        return f"t.List[{typed(kind[:-2])}]"
    return {"number": "float", "text": "str", "bool": "bool", "any": "t.Any", "list": "t.List[t.Any]"}.get(kind, kind)


def used(kind):
    return {name for name in re.findall(r"[A-Z]\w+", kind)}


def stub(document):
    records = parsed(document)
    waiting = [name for answer in ANSWERS for row in records[answer] for name in used(row[1])] + ALSO
    needed = set()
    while waiting:
        name = waiting.pop()
        if name not in needed:
            needed.add(name)
            waiting += [other for row in records[name] for other in used(row[1])]
    out = HEAD
    for name in sorted(needed):
        fields = [(key.rstrip("?"), key.endswith("?"), typed(kind)) for key, kind, *_ in records[name]]
        kinds = {key: f"x.NotRequired[{kind}]" if optional else kind for key, optional, kind in fields}
        if any(keyword.iskeyword(key) for key in kinds):
            inside = ", ".join(f'"{key}": {kind}' for key, kind in kinds.items())
            out += f'{name} = x.TypedDict("{name}", {{{inside}}})\n\n'
            continue
        out += f"class {name}(x.TypedDict):\n" + "".join(f"    {key}: {kind}\n" for key, kind in kinds.items()) + "\n"
    for answer, (name, hidden) in ANSWERS.items():
        rows = [(row[0].rstrip("?"), row) for row in records[answer]]
        out += f"class {name}:\n"
        for key, (_, kind, _, meaning, *_) in rows:
            if key not in hidden and not keyword.iskeyword(key):
                out += f"    {key}: {typed(kind)}\n    {meaning!r}\n"
        out += "\n"
    return out.rstrip() + "\n"


if __name__ == "__main__":
    WRITTEN.write_text(stub((HERE.parent / "docs/json.md").read_text()))
