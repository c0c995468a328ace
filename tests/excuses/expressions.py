"""The text of a PDDL file goes in; the places of its expressions come out, and the same text with facts, actions or objects changed.

Nothing here is taken from the program under test. A text is cut and pasted by the places of its expressions, so what is not changed
stays as it was written. Words are compared without case.
"""

import re

WORD = re.compile(r"[^\s()';]+")


class Expression:
    """A word or a list of expressions, with the place of its first character and the place after its last one."""

    def __init__(self, start, word=None):
        self.start, self.end, self.word, self.items = start, None, word, [] if word is None else None

    def head(self):
        """The first word of a list."""
        return self.items[0].word if self.items and self.items[0].word is not None else None

    def words(self):
        """All words, in their order."""
        stack, words = [self], []
        while stack:
            top = stack.pop()
            if top.word is not None:
                words.append(top.word)
            else:
                stack.extend(reversed(top.items))
        return words

    def atom(self):
        """The words of a list without lists in it, or nothing."""
        if self.items and all(item.word is not None for item in self.items):
            return tuple(item.word for item in self.items)
        return None


def read(text):
    """The expression that a text consists of."""
    root, place = Expression(0), 0
    stack = [root]
    while place < len(text):
        letter = text[place]
        if letter == ";":
            place = (text.find("\n", place) + 1) or len(text)
        elif letter == "(":
            stack.append(Expression(place))
            place += 1
        elif letter == ")":
            place += 1
            done = stack.pop()
            done.end = place
            if not stack:
                raise ValueError(f"a `)` too many at {place}")
            stack[-1].items.append(done)
        elif found := WORD.match(text, place):
            word = Expression(place, found[0].lower())
            place = word.end = found.end()
            stack[-1].items.append(word)
        else:
            place += 1
    if len(stack) != 1 or len(root.items) != 1:
        raise ValueError("the text is not one expression")
    return root.items[0]


def section(tree, name):
    """The section of a domain or problem whose first word is this."""
    return next((item for item in tree.items if item.items and item.head() == name), None)


def atom(text):
    """`(at a b)` as a tuple of words."""
    found = read(text).atom()
    if found is None:
        raise ValueError(f"{text} is no atom")
    return found


def written(words):
    """A tuple of words as `(at a b)`."""
    return f"({' '.join(words)})"


def facts(problem):
    """The atoms of the initial state with their expressions; numbers, negations and timed facts are left out."""
    found = []
    for item in section(problem, ":init").items[1:]:
        words = item.atom()
        if words and words[0] not in ("=", "not", "at") or words and words[0] == "at" and not is_number(words[1]):
            found.append((words, item))
    return found


def is_number(word):
    return re.fullmatch(r"\d+(\.\d+)?", word) is not None


def typed(items):
    """The names of a typed list, each with the type as it is written: words as strings, `(either ..)` as an expression."""
    names, waiting, index = [], [], 0
    while index < len(items):
        if items[index].word == "-":
            names += [(name, items[index + 1]) for name in waiting]
            waiting, index = [], index + 2
        else:
            waiting.append(items[index])
            index += 1
    return names + [(name, None) for name in waiting]


def objects(problem):
    """The names of the objects that a problem declares."""
    found = section(problem, ":objects")
    return [name.word for name, _ in typed(found.items[1:])] if found else []


def actions(domain):
    """The actions of a domain: name and expression."""
    return [(item.items[1].word, item) for item in domain.items if item.items and item.head() == ":action"]


def cut(text, places):
    """A text without these stretches."""
    for start, end in sorted(places, reverse=True):
        text = text[:start] + text[end:]
    return text


def without_facts(text, removed):
    """A problem without these facts."""
    removed = set(removed)
    return cut(text, [(item.start, item.end) for words, item in facts(read(text)) if words in removed])


def without_action(text, name):
    """A domain without this action."""
    return cut(text, [(item.start, item.end) for word, item in actions(read(text)) if word == name])


def without_object(text, name):
    """A problem without this object and without all that the initial state says of it."""
    problem = read(text)
    found = section(problem, ":objects")
    kept = []
    for word, kind in typed(found.items[1:]):
        if word.word != name:
            kept.append(word.word + (f" - {text[kind.start:kind.end]}" if kind else ""))
    places = [(item.start, item.end) for item in section(problem, ":init").items[1:] if name in item.words()]
    places.sort(reverse=True)
    list_place = (found.items[1].start, found.items[-1].end)
    for start, end in sorted([*places, list_place], reverse=True):
        text = text[:start] + ("\n ".join(kept) if (start, end) == list_place else "") + text[end:]
    return text


def with_object(text, name, kind):
    """A problem with one more object of a type."""
    tree = read(text)
    found = section(tree, ":objects")
    if found:
        # In front, so that what a list without types ends with does not get this one's type.
        place, new = found.items[0].end, f" {name}" + ("" if kind == "object" and not any(word.word == "-" for word in found.items) else f" - {kind}")
    else:
        place, new = section(tree, ":init").start, f"(:objects {name} - {kind})\n "
    return text[:place] + new + " " + text[place:]


def edited(text, edits):
    """A problem after edits, pairs of the atom that goes and the atom that comes, either of which may be missing."""
    there = {words for words, _ in facts(read(text))}
    gone = {before for before, _ in edits if before}
    come = [after for _, after in edits if after]
    if missing := gone - there:
        raise ValueError(f"{written(sorted(missing)[0])} is not in the initial state")
    if double := [after for after in come if after in there - gone]:
        raise ValueError(f"{written(double[0])} is in the initial state already")
    text = without_facts(text, gone)
    end = section(read(text), ":init").end - 1
    return text[:end] + "".join(f"\n  {written(after)}" for after in come) + "\n" + text[end:]


def patterns(problem):
    """What could be an atom of the goal: tuples of words, variables among them."""
    found, stack = [], section(problem, ":goal").items[1:]
    while stack:
        item = stack.pop()
        if item.items is None:
            continue
        words = item.atom()
        # A list of variables is no atom, and an equality is none of the state.
        if words and words[0] != "=" and not words[0].startswith("?") and words[0] not in ("and", "or", "not"):
            found.append(words)
        else:
            stack.extend(item.items)
    return found


def matches(pattern, words):
    """Whether an atom is an instance of a pattern."""
    if len(pattern) != len(words) or pattern[0] != words[0]:
        return False
    values = {}
    return all(values.setdefault(left, right) == right if left.startswith("?") else left == right
               for left, right in zip(pattern[1:], words[1:]))
