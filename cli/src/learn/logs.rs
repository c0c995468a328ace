//! Logs of demonstrations go in; operators, problems, plans, way points and time lines come out.

use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

use indicatif::{ProgressBar, ProgressStyle};
use lang::model::Domain;
use learner::log::{BadLine, Header};
use learner::moves::{self, Constrained};
use learner::observe::{Config, Observer, Vocabulary};
use learner::operators::record::{Record, Recorder};
use learner::operators::routine::{Shown, routines};
use learner::operators::synergy::Synergy;
use learner::operators::track::Tracks;
use learner::operators::words::{ACTOR, Words};
use learner::operators::{Options, Taught, learn as learn_operators, letter};
use learner::rule::Learned;
use learner::segment::{self, Induction, Samples, Segment, Segmenter, Tree};
use learner::waypoints::Routine;
use learner::{problem, truth};

use super::{Failure, Kind, deliver, groups, open, options, report, text, verify, write_with};
use crate::args::learn::{BadLines, Learn, RuleName, SynergyName};
use crate::exit::Exit;
use crate::files::{self, Complaint};
use crate::terminal::Terminal;

/// The thresholds and words of observation.
pub fn config(arguments: &Learn) -> Result<Config, Complaint> {
    let Some(path) = &arguments.config else { return Ok(Config::default()) };
    let text = files::read(path)?.text;
    let config: Config = serde_json::from_str(&text).map_err(|error| {
        Complaint::new(format!("`{}` is no configuration: {error}", files::name(path)))
    })?;
    let wrong = config.check().err().map(|error| error.to_string());
    let wrong = wrong.or_else(|| {
        config.vocabulary.check(&config.relations).err().map(|error| error.to_string())
    });
    match wrong {
        Some(wrong) => Err(Complaint::new(format!("`{}`: {wrong}", files::name(path)))),
        None => Ok(config),
    }
}

/// What is known of one log.
struct Seen {
    record: Record,
    tracks: Tracks,
    segments: Vec<Segment>,
    /// Lines that were left out.
    bad: u64,
}

/// What is asked about frames while they pass.
struct Watch<'a> {
    arguments: &'a Learn,
    config: &'a Config,
    tree: Tree,
    /// Whether way points are asked for, which need the ways of hands.
    tracked: bool,
}

/// At most so many bad lines are named for each log.
const NAMED: u64 = 5;

/// Reads one log through.
fn see(
    watch: &Watch<'_>,
    path: &Path,
    kind: Kind,
    samples: Option<(&Path, &mut Samples)>,
    terminal: &mut Terminal,
) -> Result<Seen, Failure> {
    let mut log = open::open(path, kind, watch.arguments.mapping.as_deref())?;
    let header = log.header().clone();
    let name = path
        .file_name()
        .map_or_else(|| files::name(path), |name| name.to_string_lossy().into_owned());
    let bar = progress(path, terminal.watched);
    // The words of a domain may leave hands out; observation never does.
    let seen_config = Config { vocabulary: Vocabulary::default(), ..watch.config.clone() };
    let mut observer = Observer::new(&header, seen_config);
    let mut recorder = Recorder::new(name, &header);
    let mut tracks = Tracks::new(&header);
    let mut segmenter =
        Segmenter::new(watch.tree.clone(), segment::Config::default(), header.hands.len());
    let mut segments = Vec::new();
    let mut truths = match &samples {
        Some((path, _)) => Some(truths(path, &header)?),
        None => None,
    };
    let mut samples = samples.map(|(_, samples)| samples);
    let mut take = |observation: &learner::observe::Observation| -> Result<(), Failure> {
        recorder.push(observation);
        segments.extend(segmenter.push(observation));
        if let (Some(truths), Some(samples)) = (&mut truths, &mut samples) {
            let Some(truth) = truths.next() else {
                return Err(Some(Complaint::new("there are fewer annotated frames than frames")));
            };
            for (state, (_, activity)) in observation.hands.iter().zip(&truth.hands) {
                samples.add(state, *activity);
            }
        }
        Ok(())
    };
    let mut bad = 0;
    let mut frames = 0_u64;
    while let Some(frame) = log.next() {
        match frame {
            Ok(frame) => {
                frames += 1;
                if watch.tracked {
                    tracks.push(&frame);
                }
                for observation in observer.push(&frame) {
                    take(&observation)?;
                }
                if frames.is_multiple_of(1024) {
                    bar.set_position(log.consumed());
                }
            }
            Err(wrong) => {
                bad += 1;
                let stop = watch.arguments.bad_lines == BadLines::Stop || wrong.is_fatal();
                if bad <= NAMED || stop {
                    terminal.say(format_args!("error: {}: {wrong}", files::name(path)));
                }
                if stop {
                    bar.finish_and_clear();
                    return Err(None);
                }
            }
        }
    }
    for observation in observer.finish() {
        take(&observation)?;
    }
    segments.extend(segmenter.finish());
    bar.finish_and_clear();
    if bad > NAMED {
        terminal.say(format_args!("{}: {bad} lines were left out in all", files::name(path)));
    }
    if frames == 0 {
        return Err(Some(Complaint::new(format!(
            "{}: there are no frames in it",
            files::name(path)
        ))));
    }
    segments
        .sort_by(|one, other| one.start.total_cmp(&other.start).then(one.hand.cmp(&other.hand)));
    Ok(Seen { record: recorder.finish(), tracks, segments, bad })
}

/// The annotated frames that belong to a log.
fn truths<'h>(
    path: &Path,
    header: &'h Header,
) -> Result<impl Iterator<Item = truth::Truth> + use<'h>, Complaint> {
    let bad = |bad: BadLine| Complaint::new(format!("{}: {bad}", files::name(path)));
    let file = File::open(path).map_err(|error| {
        Complaint::new(format!("`{}` cannot be read: {error}", files::name(path)))
    })?;
    let reader = truth::Reader::new(BufReader::new(file), header).map_err(bad)?;
    let all: Result<Vec<truth::Truth>, BadLine> = reader.collect();
    Ok(all.map_err(bad)?.into_iter())
}

/// A bar that follows the bytes of a file.
fn progress(path: &Path, watched: bool) -> ProgressBar {
    let length = std::fs::metadata(path).map(|data| data.len()).unwrap_or_default();
    if !watched || length < 1 << 22 {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{wide_bar} {bytes}/{total_bytes} {eta}");
    ProgressBar::new(length).with_style(style.expect("the template is well formed"))
}

/// Learns from logs.
pub fn learn(
    arguments: &Learn,
    config: &Config,
    kinds: &[Kind],
    terminal: &mut Terminal,
) -> Result<Exit, Failure> {
    let watch =
        Watch { arguments, config, tree: Tree::published(), tracked: arguments.output.is_some() };
    if !arguments.truth.is_empty() && arguments.truth.len() != arguments.files.len() {
        return Err(Some(Complaint::new(format!(
            "{} logs need as many files of annotated frames, and --truth names {}",
            arguments.files.len(),
            arguments.truth.len()
        ))));
    }
    let mut samples = Samples::default();
    let mut seen = Vec::new();
    for (number, (path, &kind)) in arguments.files.iter().zip(kinds).enumerate() {
        let truth = arguments.truth.get(number).map(|path| (path.as_path(), &mut samples));
        seen.push(see(&watch, path, kind, truth, terminal)?);
    }
    let bad: u64 = seen.iter().map(|one| one.bad).sum();
    let end = if bad > 0 { Exit::Findings } else { Exit::Done };
    if !arguments.truth.is_empty() {
        let tree = segment::induce(&samples, &Induction::default());
        terminal.data(tree.expect("each log has frames"));
        return Ok(end);
    }
    if let Some(path) = &arguments.segments_svg {
        let all: Vec<String> =
            seen.iter().map(|one| segment::picture(&one.record.header, &one.segments)).collect();
        if all.len() > 1 {
            return Err(Some(Complaint::new("a picture shows one log; name one")));
        }
        files::write(path, all[0].as_bytes())?;
    }
    if arguments.segments {
        for one in &seen {
            if seen.len() > 1 {
                terminal.line(&one.record.name);
            }
            terminal.data(segment::timeline(&one.record.header, &one.segments));
        }
        return Ok(end);
    }
    let found = operators(arguments, config, seen, terminal)?;
    Ok(if found { end } else { Exit::Findings })
}

/// Which words hold for a log: who acts in the place of each hand.
fn words(arguments: &Learn, config: &Config, header: &Header) -> Result<Words, Complaint> {
    let mut words = Words::of(header, config.vocabulary.clone());
    if arguments.map.is_empty() {
        return Ok(words);
    }
    for (hand, _) in &arguments.map {
        if header.hand(hand).is_none() {
            let hands: Vec<&str> = header.hands.iter().map(|one| one.name.as_str()).collect();
            return Err(Complaint::with_help(
                format!("no hand is called `{hand}`"),
                format!("the log has {}", hands.join(" and ")),
            ));
        }
    }
    words.actors = header
        .hands
        .iter()
        .map(|hand| {
            let found = arguments.map.iter().find(|(from, _)| hand.name.eq_ignore_ascii_case(from));
            found.map(|(_, to)| to.clone())
        })
        .collect();
    Ok(words)
}

/// Learns operators and writes everything that was asked for; says whether there is any operator.
fn operators(
    arguments: &Learn,
    config: &Config,
    seen: Vec<Seen>,
    terminal: &mut Terminal,
) -> Result<bool, Failure> {
    let known = match &arguments.extend {
        Some(path) => Some(super::traces::read(path, &[], terminal)?),
        None => None,
    };
    let mut demonstrations = Vec::new();
    let mut tracks = Vec::new();
    for one in seen {
        let words = words(arguments, config, &one.record.header)?;
        tracks.push(one.tracks);
        demonstrations.push((one.record, words));
    }
    let options = Options {
        rule: options(arguments),
        synergy: match arguments.synergy {
            SynergyName::Thesis => Synergy::Thesis,
            SynergyName::Flag => Synergy::Flag,
            SynergyName::Needed => Synergy::Needed,
        },
        agents: arguments.agents,
        title: arguments.name.clone(),
    };
    let domain = known.as_ref().map(|(domain, _, _)| domain);
    let taught = learn_operators(&demonstrations, domain, &options);
    let learned = match arguments.rule {
        RuleName::Changed if !arguments.agents => {
            letter::learn(&demonstrations, domain, &arguments.name, &Tree::published())
        }
        _ => taught.learned.clone(),
    };
    for ((record, _), (_, line)) in demonstrations.iter().zip(&taught.lines) {
        tell(record, line, terminal);
    }
    if !taught.missing.is_empty() {
        let missing = taught.missing.join(", ");
        terminal.say(format_args!(
            "note: the domain does not have {missing}; what was seen of that is left out."
        ));
        if taught.missing.iter().any(|what| *what == format!("the type `{ACTOR}`")) {
            terminal.say(
                "  = help: where a domain names no hands, --config says so, as in {\"vocabulary\": {\"in-hand\": \"(holding ?object)\"}}",
            );
        }
    }
    let mut constrained = Constrained::new();
    let mut names = verify::Names::new();
    let text = if let Some((domain, source, _)) = &known {
        let extension = super::extend::merged(source, domain, &learned, terminal);
        names = extension.names;
        extension.text
    } else {
        if learned.actions.is_empty() && learned.refused.is_empty() {
            terminal.say("No operators were learned: nothing changed that a hand did.");
        } else {
            report(&learned, terminal);
        }
        let (text, moves) = whole(arguments, config, &taught, &learned);
        constrained = moves;
        text
    };
    let products = Products {
        taught: &taught,
        learned: &learned,
        text: &text,
        constrained: &constrained,
        names: &names,
    };
    deliver(arguments.output.as_deref(), &text, terminal)?;
    write_beside(arguments, &demonstrations, &tracks, &products, terminal)?;
    Ok(!learned.actions.is_empty())
}

/// Says what was seen in a log.
fn tell(record: &Record, line: &learner::operators::line::Line, terminal: &mut Terminal) {
    let steps = line.instances.len();
    let done = match steps {
        0 if line.mute.is_empty() => "nothing was done".to_owned(),
        0 => "nothing was done that there are words for".to_owned(),
        1 => "one action".to_owned(),
        count => format!("{count} actions"),
    };
    terminal.say(format_args!(
        "{}: {} frames, {:.1} s, {done}.",
        record.name, record.frames, record.end
    ));
    match line.strays {
        0 => {}
        1 => {
            terminal.say("note: one change came about with no hand near, and is credited to none.");
        }
        count => terminal.say(format_args!(
            "note: {count} changes came about with no hand near, and are credited to none."
        )),
    }
    if !line.mute.is_empty() {
        terminal.say(format_args!(
            "note: there are no words for what these change: {}.",
            line.mute.join(", ")
        ));
    }
}

/// The text of a domain of its own.
fn whole(
    arguments: &Learn,
    config: &Config,
    taught: &Taught,
    learned: &Learned,
) -> (String, Constrained) {
    let mut constrained = Constrained::new();
    let traces: Vec<_> = taught.lines.iter().map(|(_, line)| line.trace.clone()).collect();
    let groups = groups(&taught.learned.domain, &traces);
    let vocabulary = &config.vocabulary;
    let text = text(learned, &groups, |domain, style| {
        if arguments.agents {
            constrained = moves::constrain(
                domain,
                style,
                &vocabulary.at.predicate,
                &vocabulary.reachable.predicate,
            );
        }
    });
    (text, constrained)
}

/// What came of demonstrations.
struct Products<'a> {
    taught: &'a Taught,
    learned: &'a Learned,
    /// The domain.
    text: &'a str,
    /// The moves that keep shared places free, each with the one that it refines.
    constrained: &'a Constrained,
    /// What learned actions are called in a domain that was extended.
    names: &'a verify::Names,
}

/// Writes the problem, the plan, the trace and the way points, as far as they were asked for, and says whether the demonstrations are plans.
fn write_beside(
    arguments: &Learn,
    demonstrations: &[(Record, Words)],
    tracks: &[Tracks],
    products: &Products<'_>,
    terminal: &mut Terminal,
) -> Result<(), Failure> {
    let Products { taught, learned, text, constrained, names } = *products;
    let (record, words) = &demonstrations[0];
    let domain = model(text);
    let begin = problem::beginning(&domain, record, words);
    let end = problem::end(&domain, record, words);
    let goal = arguments.goal.clone().unwrap_or_else(|| problem::achieved(&begin, &end));
    let title = format!("{}-shown", domain.name.text);
    let written = problem::text(&domain, &title, &begin, &goal);
    let (deeds, line) = &taught.lines[0];
    let mut told = verify::told(deeds, line, learned);
    told.rename(names);
    if let Some(path) = &arguments.problem {
        files::write(path, written.as_bytes())?;
    }
    if let Some(path) = &arguments.plan_file {
        files::write(path, told.text(arguments.agents).as_bytes())?;
    }
    if let Some(path) = &arguments.trace {
        write_with(path, |out| {
            for (_, line) in &taught.lines {
                out.write_all(
                    learner::trace::print(&line.trace, &taught.learned.domain).as_bytes(),
                )?;
            }
            Ok(())
        })?;
    }
    let judged = arguments.rule != RuleName::Changed && arguments.extend.is_none();
    if judged && !line.instances.is_empty() && line.strays == 0 {
        let plain = learner::write::text(learned);
        let own = model(&plain);
        let begin = problem::beginning(&own, record, words);
        let end = problem::end(&own, record, words);
        let goal = problem::achieved(&begin, &end);
        let problem = problem::text(&own, &title, &begin, &goal);
        if let Err(story) = verify::judge(&plain, &problem, &told) {
            terminal.say(format_args!(
                "warning: with what was learned, the demonstration itself does not lead to its end:\n{story}"
            ));
        }
    }
    if let Some(output) = &arguments.output {
        let shown: Vec<Shown<'_>> = demonstrations
            .iter()
            .zip(tracks)
            .zip(&taught.lines)
            .map(|(((record, words), tracks), (deeds, line))| Shown {
                header: &record.header,
                tracks,
                deeds,
                line,
                names_hands: words.names_hands(),
            })
            .collect();
        let mut routines = routines(&shown, &taught.learned);
        let own = routines.clone();
        for routine in &mut routines {
            if let Some((name, places)) = names.get(&routine.action) {
                *routine = routine.renamed(name, places);
            }
        }
        for (name, like, follows) in constrained {
            for same in own.iter().filter(|routine| routine.action == *like) {
                routines.push(Routine { action: name.clone(), follows: *follows, ..same.clone() });
            }
        }
        if !routines.is_empty() {
            let text = serde_json::to_string_pretty(&routines).expect("way points are plain data");
            files::write(&beside(output), text.as_bytes())?;
        }
    }
    Ok(())
}

/// Where way points lie: beside the domain.
fn beside(output: &Path) -> PathBuf {
    output.with_extension("routines.json")
}

/// The model of a domain that was just written.
fn model(text: &str) -> Domain {
    let mut sources = lang::source::Sources::default();
    let id = sources.add("domain.pddl", text);
    lang::read_domain(&sources, id).0
}
