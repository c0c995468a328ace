"""The language server, spoken to by pytest-lsp as neovim, VS Code and Emacs would: every feature, once or more.

The variable CAVEAT names the program; `.ci/clients` sets it.
"""

import asyncio
import os
import pathlib
import shutil

import pytest
import pytest_lsp
from lsprotocol import types
from pytest_lsp import ClientServerConfig, LanguageClient, client_capabilities

CAVEAT = os.environ.get("CAVEAT", "caveat")
FOLDER = pathlib.Path(__file__).parent / "folder"


# How a text is encoded to count columns in what was agreed on, and how many bytes a column has then.
UNITS = {"utf-8": ("utf-8", 1), "utf-16": ("utf-16-le", 2), "utf-32": ("utf-32-le", 4)}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A copy of the folder, since renames are tried on it."""
    copy = tmp_path_factory.mktemp("pddl")
    for file in FOLDER.iterdir():
        shutil.copy(file, copy)
    return copy


@pytest_lsp.fixture(
    config=ClientServerConfig(server_command=[CAVEAT, "lsp"]),
    params=["neovim", "visual_studio_code", "emacs"],
    scope="module",
)
async def client(request, folder, lsp_client: LanguageClient):
    @lsp_client.feature(types.CLIENT_REGISTER_CAPABILITY)
    def register(parameters):
        """Editors watch files when they are asked to; this one lets the server ask."""

    result = await lsp_client.initialize_session(
        types.InitializeParams(
            capabilities=client_capabilities(request.param),
            root_uri=folder.as_uri(),
            workspace_folders=[types.WorkspaceFolder(uri=folder.as_uri(), name="pddl")],
        )
    )
    lsp_client.units = UNITS[result.capabilities.position_encoding or "utf-16"]
    yield
    await lsp_client.shutdown_session()


class Document:
    """An open document, changed as an editor changes it."""

    def __init__(self, client, path):
        self.client, self.uri, self.version = client, path.as_uri(), 1
        self.text = path.read_text()
        client.diagnostics.pop(self.uri, None)
        client.text_document_did_open(
            types.DidOpenTextDocumentParams(
                types.TextDocumentItem(
                    uri=self.uri, language_id="pddl", version=1, text=self.text
                )
            )
        )

    def at(self, marked, offset=0):
        """The position of the first place that `marked` stands at."""
        index = self.text.index(marked) + offset
        line = self.text.count("\n", 0, index)
        start = self.text.rfind("\n", 0, index) + 1
        encoding, width = self.client.units
        return types.Position(line, len(self.text[start:index].encode(encoding)) // width)

    @property
    def this(self):
        return types.TextDocumentIdentifier(uri=self.uri)

    async def change(self, old, new):
        """Replaces one piece of the text by an incremental change and waits for what is said then."""
        start, end = self.at(old), self.at(old, len(old))
        self.text = self.text.replace(old, new, 1)
        self.version += 1
        self.client.diagnostics.pop(self.uri, None)
        self.client.text_document_did_change(
            types.DidChangeTextDocumentParams(
                types.VersionedTextDocumentIdentifier(uri=self.uri, version=self.version),
                [types.TextDocumentContentChangePartial(range=types.Range(start, end), text=new)],
            )
        )
        return await self.said()

    async def said(self):
        for _ in range(200):
            if self.uri in self.client.diagnostics:
                return list(self.client.diagnostics[self.uri])
            await asyncio.sleep(0.02)
        raise AssertionError("the server says nothing of " + self.uri)

    def close(self):
        self.client.text_document_did_close(types.DidCloseTextDocumentParams(self.this))


@pytest.fixture
async def domain(client, folder):
    document = Document(client, folder / "domain.pddl")
    yield document
    document.close()


@pytest.fixture
async def problem(client, folder):
    document = Document(client, folder / "p01.pddl")
    yield document
    document.close()


def codes(diagnostics):
    return [one.code for one in diagnostics]


def apply(text, edits, units=("utf-16-le", 2)):
    """The text after edits; on a line of ASCII every encoding counts the same."""
    lines = text.splitlines(keepends=True)

    def index(position):
        line = "".join(lines[: position.line])
        rest = lines[position.line] if position.line < len(lines) else ""
        encoding, width = units
        return len(line) + len(rest.encode(encoding)[: width * position.character].decode(encoding))

    for edit in sorted(edits, key=lambda edit: index(edit.range.start), reverse=True):
        text = text[: index(edit.range.start)] + edit.new_text + text[index(edit.range.end) :]
    return text


@pytest.mark.asyncio(loop_scope="module")
async def test_diagnostics_follow_what_is_typed(domain):
    assert await domain.said() == []
    said = await domain.change("(clean ?c)))\n", "(claen ?c)))\n")
    assert codes(said) == ["E0101"]
    assert said[0].range.start == domain.at("claen")
    assert said[0].severity == types.DiagnosticSeverity.Error
    said = await domain.change("; Cups", "; 🍵 Täßchen, cups (")
    assert codes(said) == ["E0101"]
    said = await domain.change("claen", "clean")
    assert said == []


@pytest.mark.asyncio(loop_scope="module")
async def test_a_position_after_wide_characters(domain):
    said = await domain.change("    :effect (clean ?c))", "    :effect #|🍵|# (claen ?c))")
    at = domain.at("claen")
    assert any(one.code == "E0101" and one.range.start == at for one in said), said


@pytest.mark.asyncio(loop_scope="module")
async def test_a_problem_is_checked_against_its_domain(problem):
    assert await problem.said() == []
    said = await problem.change("(at red shelf)", "(at shelf red)")
    assert codes(said) == ["E0202"]
    related = said[0].related_information
    assert related and related[0].location.uri.endswith("domain.pddl")


@pytest.mark.asyncio(loop_scope="module")
async def test_a_domain_that_changes_changes_what_its_problem_says(domain, problem):
    await domain.said()
    assert await problem.said() == []
    problem.client.diagnostics.pop(problem.uri, None)
    await domain.change("(clean ?c - cup)", "(tidy ?c - cup)")
    assert "E0101" in codes(await problem.said())


@pytest.mark.asyncio(loop_scope="module")
async def test_a_quick_fix(client, domain):
    said = await domain.change(":parameters (?c - cup)\n", ":parametres (?c - cup)\n")
    assert codes(said) == ["E0005"]
    actions = await client.text_document_code_action_async(
        types.CodeActionParams(
            domain.this, said[0].range, types.CodeActionContext(diagnostics=said)
        )
    )
    fixes = [one for one in actions if one.kind == types.CodeActionKind.QuickFix]
    assert fixes
    edit = fixes[0].edit
    changes = edit.changes[domain.uri] if edit.changes else edit.document_changes[0].edits
    assert ":parameters (?c - cup)\n" in apply(domain.text, changes)


@pytest.mark.asyncio(loop_scope="module")
async def test_a_missing_requirement_is_added(client, domain):
    said = await domain.change("(not (clean ?c))", "(or (clean ?c) (free sink))")
    assert codes(said) == ["W0302"]
    actions = await client.text_document_code_action_async(
        types.CodeActionParams(
            domain.this, said[0].range, types.CodeActionContext(diagnostics=said)
        )
    )
    texts = []
    for one in actions:
        if one.edit:
            edit = one.edit
            changes = edit.changes[domain.uri] if edit.changes else edit.document_changes[0].edits
            texts.append(apply(domain.text, changes))
    assert any(":negative-preconditions :disjunctive-preconditions)" in text for text in texts)


@pytest.mark.asyncio(loop_scope="module")
async def test_hover_shows_declaration_comment_and_use(client, domain):
    await domain.said()
    hover = await client.text_document_hover_async(
        types.HoverParams(domain.this, domain.at("(at ?c sink)", 1))
    )
    shown = hover.contents.value
    assert "(at ?c - cup ?p - place)" in shown
    assert "where a cup stands" in shown
    assert "wash" in shown and "move" in shown


@pytest.mark.asyncio(loop_scope="module")
async def test_definition_from_the_problem(client, domain, problem):
    await problem.said()
    found = await client.text_document_definition_async(
        types.DefinitionParams(problem.this, problem.at("(clean red)", 1))
    )
    found = found if isinstance(found, list) else [found]
    target = found[0]
    uri = getattr(target, "uri", None) or target.target_uri
    place = getattr(target, "range", None) or target.target_selection_range
    assert uri.endswith("domain.pddl")
    assert place.start == domain.at("(clean ?c - cup)", 1)


@pytest.mark.asyncio(loop_scope="module")
async def test_references_in_all_files(client, domain):
    await domain.said()
    found = await client.text_document_references_async(
        types.ReferenceParams(
            text_document=domain.this,
            position=domain.at("(clean ?c - cup)", 1),
            context=types.ReferenceContext(include_declaration=True),
        )
    )
    files = sorted(one.uri.rsplit("/", 1)[-1] for one in found)
    assert files == ["domain.pddl"] * 3 + ["p01.pddl"]


@pytest.mark.asyncio(loop_scope="module")
@pytest.mark.parametrize(
    "place, files",
    [
        ("(clean ?c - cup)", 2),  # a predicate
        ("(:action move", 1),
        ("?from ?to - place", 1),
        ("cup place)", 2),  # a type
        ("sink - place", 2),  # a constant
    ],
)
async def test_rename(client, domain, place, files):
    await domain.said()
    offset = {"(": 1, "?": 0}.get(place[0], 0)
    if place.startswith("(:action"):
        offset = len("(:action ")
    edit = await client.text_document_rename_async(
        types.RenameParams(domain.this, domain.at(place, offset), "renamed")
    )
    changes = edit.changes or {
        change.text_document.uri: change.edits for change in edit.document_changes
    }
    assert len(changes) == files
    renamed = apply(domain.text, changes[domain.uri])
    assert renamed.count("renamed") == len(changes[domain.uri])


@pytest.mark.asyncio(loop_scope="module")
async def test_rename_of_an_object(client, domain, problem):
    await problem.said()
    edit = await client.text_document_rename_async(
        types.RenameParams(problem.this, problem.at("red blue"), "green")
    )
    changes = edit.changes or {
        change.text_document.uri: change.edits for change in edit.document_changes
    }
    assert list(changes) == [problem.uri]
    assert apply(problem.text, changes[problem.uri]).count("green") == 3


@pytest.mark.asyncio(loop_scope="module")
async def test_rename_to_a_name_that_is_taken_is_refused(client, domain):
    await domain.said()
    with pytest.raises(Exception, match="clean"):
        await client.text_document_rename_async(
            types.RenameParams(domain.this, domain.at("(free ?p - place)", 1), "clean")
        )


@pytest.mark.asyncio(loop_scope="module")
async def test_completion_by_expected_type(client, problem):
    await problem.change("(at red shelf)", "(at red )")
    found = await client.text_document_completion_async(
        types.CompletionParams(problem.this, problem.at("(at red )", len("(at red ")))
    )
    items = found if isinstance(found, list) else found.items
    labels = [one.label for one in sorted(items, key=lambda one: one.sort_text or one.label)]
    assert "shelf" in labels and "sink" in labels
    assert "blue" not in labels or labels.index("shelf") < labels.index("blue")


@pytest.mark.asyncio(loop_scope="module")
async def test_completion_of_predicates_and_keywords(client, domain):
    await domain.change("(and (at ?c sink)", "(and (")
    found = await client.text_document_completion_async(
        types.CompletionParams(domain.this, domain.at("(and (", len("(and (")))
    )
    items = found if isinstance(found, list) else found.items
    labels = {one.label for one in items}
    assert {"at", "clean", "free", "not", "exists"} <= labels


@pytest.mark.asyncio(loop_scope="module")
async def test_signature_help(client, domain):
    await domain.said()
    found = await client.text_document_signature_help_async(
        types.SignatureHelpParams(domain.this, domain.at("(at ?c ?from)", len("(at ?c ")))
    )
    assert found.signatures[0].label.startswith("(at ?c - cup ?p - place")
    active = found.active_parameter
    if active is None:
        active = found.signatures[0].active_parameter
    assert active == 1


@pytest.mark.asyncio(loop_scope="module")
async def test_symbols(client, domain):
    await domain.said()
    found = await client.text_document_document_symbol_async(
        types.DocumentSymbolParams(domain.this)
    )

    def names(symbols):
        for one in symbols:
            yield one.name
            yield from names(getattr(one, "children", None) or [])

    assert {"wash", "move", "at", "clean", "cup", "sink"} <= set(names(found))
    found = await client.workspace_symbol_async(types.WorkspaceSymbolParams("was"))
    assert [one.name for one in found] == ["wash"]


@pytest.mark.asyncio(loop_scope="module")
async def test_semantic_tokens(client, domain):
    await domain.said()
    found = await client.text_document_semantic_tokens_full_async(
        types.SemanticTokensParams(domain.this)
    )
    assert len(found.data) % 5 == 0 and len(found.data) > 5 * 60


@pytest.mark.asyncio(loop_scope="module")
async def test_folding_and_selection(client, domain):
    await domain.said()
    found = await client.text_document_folding_range_async(
        types.FoldingRangeParams(domain.this)
    )
    assert any(one.start_line == 10 and one.end_line == 13 for one in found)
    found = await client.text_document_selection_range_async(
        types.SelectionRangeParams(domain.this, [domain.at("(at ?c sink)", 1)])
    )
    depth, one = 0, found[0]
    while one:
        depth, one = depth + 1, one.parent
    assert depth >= 5


@pytest.mark.asyncio(loop_scope="module")
async def test_formatting(client, domain):
    await domain.change("  (:types cup place)", "      (:types    cup   place)")
    found = await client.text_document_formatting_async(
        types.DocumentFormattingParams(
            domain.this, types.FormattingOptions(tab_size=2, insert_spaces=True)
        )
    )
    formatted = apply(domain.text, found)
    assert "\n  (:types cup place)\n" in formatted
    assert "; where a cup stands" in formatted


@pytest.mark.asyncio(loop_scope="module")
async def test_highlights(client, domain):
    await domain.said()
    found = await client.text_document_document_highlight_async(
        types.DocumentHighlightParams(domain.this, domain.at("(free ?to)", 1))
    )
    kinds = [one.kind for one in found]
    assert kinds.count(types.DocumentHighlightKind.Write) >= 2
    assert types.DocumentHighlightKind.Read in kinds


@pytest.mark.asyncio(loop_scope="module")
async def test_a_plan_is_validated(client, folder):
    (folder / "p01.plan").write_text("(wash red)\n")
    plan = Document(client, folder / "p01.plan")
    said = await plan.said()
    assert said and said[0].code in ("E0720", "E0721"), said
    plan.close()
    (folder / "p01.plan").unlink()
