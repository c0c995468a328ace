#!/usr/bin/env python3
"""Tables with known graphs go in; how near pgmpy, pyAgrum, causal-learn and caveat come, and what they cost, come out as Markdown.

    python3 tests/causal/peers.py ../shared/corpus CAVEAT_EXAMPLES [accuracy|speed|read CAVEAT]

CAVEAT_EXAMPLES is the folder of the built examples `discover` and `inference` (target/release/examples). Needs pgmpy 1.1.2, pyagrum and
causal-learn. Peers run in processes of their own, so that what one imports costs the others nothing; times are processor seconds of the
call alone. A job that takes longer than ten minutes is stopped, and its row says so.
"""
import json
import multiprocessing
import os
import subprocess
import sys
import time
import warnings

warnings.filterwarnings("ignore")
NETS = ["asia", "sachs", "child", "insurance", "alarm"]
FILES = ["p1", "p2"]
LIMIT = int(os.environ.get("LIMIT", "600"))


def path(corpus, net, file):
    return f"{corpus}/causal/data/{net}_{file}_10000.csv"


def truth(corpus, net):
    """How each pair of variables is joined in the true pattern."""
    known = json.load(open(f"{corpus}/causal/truth/{net}.json"))
    joins = {frozenset(arc): tuple(arc) for arc in known["cpdag_directed"]}
    joins.update({frozenset(arc): "undirected" for arc in known["cpdag_undirected"]})
    return joins


def distance(corpus, net, directed, undirected):
    joins = {frozenset(arc): tuple(arc) for arc in directed}
    joins.update({frozenset(arc): "undirected" for arc in undirected})
    true = truth(corpus, net)
    return sum(joins.get(pair) != true.get(pair) for pair in set(joins) | set(true))


def pattern_of_arcs(names, arcs):
    """The pattern of a graph, by pyAgrum."""
    import pyagrum as gum

    model = gum.BayesNet()
    ids = {name: model.add(gum.LabelizedVariable(name, name, 2)) for name in names}
    for one, other in arcs:
        model.addArc(ids[one], ids[other])
    essential = gum.EssentialGraph(model)
    back = {number: name for name, number in ids.items()}
    directed = [(back[a], back[b]) for a, b in essential.arcs()]
    return directed, [(back[a], back[b]) for a, b in essential.edges()]


def pgmpy_data(file):
    import pandas

    return pandas.read_csv(file, dtype=str, keep_default_na=False).astype("category")


def gum_learner(file):
    import pyagrum as gum

    learner = gum.BNLearner(file)
    learner.setNumberOfThreads(1)
    return learner


def run_gum(method, file):
    import pyagrum as gum

    learner = gum_learner(file)
    start = time.process_time()
    if method == "hill climbing":
        learner.useScoreBIC()
        learner.useGreedyHillClimbing()
        # Only the graph: its parameters cannot be learned where a combination of parent states is not seen.
        graph = learner.learnDAG()
        seconds = time.process_time() - start
        names = list(learner.names())
        arcs = [(learner.nameFromId(a), learner.nameFromId(b)) for a, b in graph.arcs()]
        return seconds, *pattern_of_arcs(names, arcs)
    if method == "MIIC":
        learner.useMIIC()
    else:
        learner.usePC()
    graph = learner.learnPDAG()
    seconds = time.process_time() - start
    name = lambda node: learner.nameFromId(node)
    return seconds, [(name(a), name(b)) for a, b in graph.arcs()], [(name(a), name(b)) for a, b in graph.edges()]


def run_pgmpy(method, file):
    data = pgmpy_data(file)
    start = time.process_time()
    if method == "hill climbing":
        from pgmpy.estimators import HillClimbSearch

        start = time.process_time()
        model = HillClimbSearch(data).estimate(scoring_method="bic-d", show_progress=False)
        seconds = time.process_time() - start
        return seconds, *pattern_of_arcs(list(data.columns), list(model.edges()))
    if method == "GES":
        from pgmpy.estimators import GES

        start = time.process_time()
        model = GES(data).estimate(scoring_method="bic-d")
        seconds = time.process_time() - start
        # What comes is a pattern: an arc without a direction is in it both ways.
        arcs = set(model.edges())
        undirected = {tuple(sorted(arc)) for arc in arcs if arc[::-1] in arcs}
        return seconds, [arc for arc in arcs if arc[::-1] not in arcs], list(undirected)
    from pgmpy.estimators import PC

    start = time.process_time()
    found = PC(data).estimate(variant="stable", ci_test="chi_square", significance_level=0.01, return_type="pdag", show_progress=False)
    seconds = time.process_time() - start
    return seconds, list(found.directed_edges), list(found.undirected_edges)


def run_cl(method, file):
    import pandas

    data = pandas.read_csv(file, dtype=str, keep_default_na=False)
    names = list(data.columns)
    numbers = data.apply(lambda column: column.astype("category").cat.codes).to_numpy()
    if method == "PC":
        from causallearn.search.ConstraintBased.PC import pc

        start = time.process_time()
        graph = pc(numbers, 0.01, "chisq", show_progress=False).G
    else:
        from causallearn.search.ScoreBased.GES import ges

        start = time.process_time()
        graph = ges(numbers, score_func="local_score_BDeu")["G"]
    seconds = time.process_time() - start
    directed, undirected = [], []
    matrix = graph.graph
    for i in range(len(names)):
        for j in range(i):
            ends = (matrix[i, j], matrix[j, i])
            # An arrow at i is written as 1 in its row.
            if ends == (-1, -1) or ends == (1, 1):
                undirected.append((names[i], names[j]))
            elif ends == (1, -1):
                directed.append((names[j], names[i]))
            elif ends == (-1, 1):
                directed.append((names[i], names[j]))
    return seconds, directed, undirected


LEARNERS = [
    ("pyAgrum", "hill climbing", run_gum),
    ("pgmpy", "hill climbing", run_pgmpy),
    ("pgmpy", "GES", run_pgmpy),
    ("causal-learn", "GES", run_cl),
    ("pyAgrum", "MIIC", run_gum),
    ("pyAgrum", "PC", run_gum),
    ("pgmpy", "PC", run_pgmpy),
    ("causal-learn", "PC", run_cl),
]


def guarded(work, *arguments):
    """Runs a job in a process of its own, with a limit."""
    ours, theirs = multiprocessing.Pipe()

    def job():
        try:
            theirs.send(work(*arguments))
        except Exception as error:
            theirs.send(f"{type(error).__name__}: {str(error)[:60]}")

    process = multiprocessing.Process(target=job)
    process.start()
    answer = ours.recv() if ours.poll(LIMIT) else f"stopped after {LIMIT} s"
    process.kill()
    process.join()
    return answer


def accuracy(corpus, examples, nets):
    print("| network, file | learner | distance to the true pattern | CPU s |\n|---|---|---|---|")
    for net in nets:
        for file in FILES:
            lines = subprocess.run([f"{examples}/discover", f"{corpus}/causal", net], capture_output=True, text=True, check=True, env=dict(os.environ, RAYON_NUM_THREADS="1")).stdout
            for line in lines.splitlines():
                cells = line.split("\t")
                if cells[1] == file and cells[2] in ("exact", "greedy", "hill", "pc"):
                    print(f"| {net} {file} | caveat {cells[2]} | {cells[3].split()[1]} | {cells[6].split()[0]} |", flush=True)
            only = os.environ.get("ONLY")
            for tool, method, work in LEARNERS:
                if only and f"{tool} {method}" not in only.split(","):
                    continue
                if (tool, method) in (("causal-learn", "GES"), ("pgmpy", "GES")) and net in ("insurance", "alarm"):
                    continue
                answer = guarded(work, method, path(corpus, net, file))
                if isinstance(answer, str):
                    print(f"| {net} {file} | {tool} {method} | {answer} | |", flush=True)
                else:
                    seconds, directed, undirected = answer
                    print(f"| {net} {file} | {tool} {method} | {distance(corpus, net, directed, undirected)} | {seconds:.3f} |", flush=True)


def fit_gum(corpus, net):
    import pyagrum as gum

    learner = gum_learner(path(corpus, net, "p1"))
    model = gum.loadBN(f"{corpus}/bif/{net}.bif")
    dag = gum.DAG()
    for name in learner.names():
        dag.addNodeWithId(learner.idFromName(name))
    for a, b in model.arcs():
        dag.addArc(learner.idFromName(model.variable(a).name()), learner.idFromName(model.variable(b).name()))
    learner.useBDeuPrior(1)
    start = time.process_time()
    learner.learnParameters(dag)
    return time.process_time() - start


def fit_pgmpy(corpus, net):
    from pgmpy.models import DiscreteBayesianNetwork
    from pgmpy.readwrite import BIFReader

    data = pgmpy_data(path(corpus, net, "p1"))
    model = DiscreteBayesianNetwork(list(BIFReader(f"{corpus}/bif/{net}.bif").get_model().edges()))
    start = time.process_time()
    model.fit(data)
    return time.process_time() - start


def ask_gum(corpus, net):
    import pyagrum as gum

    model = gum.loadBN(f"{corpus}/bif/{net}.bif")
    queries = json.load(open(f"{corpus}/causal/data/{net}_queries.json"))
    start = time.process_time()
    for query in queries:
        engine = gum.LazyPropagation(model)
        engine.setEvidence(query["evidence"])
        engine.addTarget(query["target"])
        engine.makeInference()
        engine.posterior(query["target"])
    return time.process_time() - start


def ask_pgmpy(corpus, net):
    from pgmpy.inference import VariableElimination
    from pgmpy.readwrite import BIFReader

    engine = VariableElimination(BIFReader(f"{corpus}/bif/{net}.bif").get_model())
    queries = json.load(open(f"{corpus}/causal/data/{net}_queries.json"))
    start = time.process_time()
    for query in queries:
        engine.query([query["target"]], evidence=query["evidence"], show_progress=False)
    return time.process_time() - start


def speed(corpus, examples, nets):
    print(subprocess.run([f"{examples}/inference", corpus], capture_output=True, text=True, check=True).stdout)
    print("| network | job | peer | CPU s |\n|---|---|---|---|")
    for net in nets:
        for job, tool, work in [("fit", "pyAgrum", fit_gum), ("fit", "pgmpy", fit_pgmpy), ("1000 queries", "pyAgrum", ask_gum), ("1000 queries", "pgmpy", ask_pgmpy)]:
            answer = guarded(work, corpus, net)
            print(f"| {net} | {job} | {tool} | {answer if isinstance(answer, str) else f'{answer:.4f}'} |", flush=True)


def answers_gum(file, net, corpus):
    import pyagrum as gum

    model = gum.loadBN(file)
    engine = gum.LazyPropagation(model)
    names = [model.variable(node).name() for node in model.nodes()]
    engine.makeInference()
    return {name: list(map(float, engine.posterior(name).tolist())) for name in names}


def answers_pgmpy(file, net, corpus):
    from pgmpy.inference import VariableElimination
    from pgmpy.readwrite import BIFReader, XMLBIFReader

    model = (BIFReader(file) if file.endswith(".bif") else XMLBIFReader(file)).get_model()
    engine = VariableElimination(model)
    found = {}
    for name in model.nodes():
        factor = engine.query([name], show_progress=False)
        # In the order of the file, which a query may have changed.
        order = model.get_cpds(name).state_names[name]
        values = dict(zip(factor.state_names[name], map(float, factor.values)))
        found[name] = [values[state] for state in order]
    return found


def read(corpus, caveat, nets):
    """Whether what caveat writes is read by others, who then give the same answers."""
    print("| network | format | reader | farthest from our answers |\n|---|---|---|---|")
    for net in nets:
        source = net if os.path.exists(net) else f"{corpus}/bif/{net}.bif"
        ours = json.loads(subprocess.run([caveat, "causal", "query", source, "--output-format", "json"], capture_output=True, text=True, check=True).stdout)
        for ending in ["bif", "xml"]:
            file = f"/tmp/caveat-written.{'bif' if ending == 'bif' else 'bifxml'}"
            subprocess.run([caveat, "causal", "show", source, "-o", file], check=True, capture_output=True)
            for tool, work in [("pyAgrum", answers_gum), ("pgmpy", answers_pgmpy)]:
                answer = guarded(work, file, net, corpus)
                if isinstance(answer, str):
                    print(f"| {net} | {ending} | {tool} | {answer} |", flush=True)
                    continue
                worst = 0.0
                plain = lambda name: name if name in answer else "".join(c if c.isascii() and c.isalnum() else "_" for c in name)
                for name, states in ours.items():
                    theirs = answer[plain(name)]
                    worst = max([worst] + [abs(one["probability"] - other) for one, other in zip(states, theirs)])
                print(f"| {net} | {ending} | {tool} | {worst:.1e} |", flush=True)


if __name__ == "__main__":
    corpus, examples = sys.argv[1], sys.argv[2]
    what = sys.argv[3] if len(sys.argv) > 3 else "accuracy"
    if what == "accuracy":
        accuracy(corpus, examples, sys.argv[4:] or NETS)
    elif what == "speed":
        speed(corpus, examples, sys.argv[4:] or ["asia", "child", "insurance", "alarm"])
    else:
        read(corpus, sys.argv[4], sys.argv[5:] or ["asia", "child", "insurance", "alarm", "sachs", "survey"])
