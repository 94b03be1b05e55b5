//! The CI files of docs/testing.md are YAML, and have the structure that GitHub and GitLab require.

use saphyr::{LoadableYamlNode, Yaml};

const PAGE: &str = include_str!("../../../docs/testing.md");

/// The code blocks of a page in one language.
fn blocks(page: &str, language: &str) -> Vec<String> {
    let begin = format!("\n```{language}\n");
    let parts = page.split(&begin).skip(1);
    parts.map(|rest| rest.split("\n```").next().unwrap().to_string() + "\n").collect()
}

/// Checks a CI file. Its first line must be a comment that states the name of the file. The error describes the fault.
fn checked(text: &str) -> Result<(), String> {
    let documents = Yaml::load_from_str(text).map_err(|error| error.to_string())?;
    let [document] = documents.as_slice() else { return Err(format!("{} documents", documents.len())) };
    match text.lines().next() {
        Some("# .github/workflows/linkproof.yml") => github(document),
        Some("# .gitlab-ci.yml") => gitlab(document),
        other => Err(format!("no file is named: {other:?}")),
    }
}

/// The entries of a mapping: names and values.
fn entries<'a>(node: &'a Yaml, what: &str) -> Result<Vec<(&'a str, &'a Yaml<'a>)>, String> {
    let mapping = node.as_mapping().ok_or_else(|| format!("{what} is no mapping"))?;
    mapping.iter().map(|(key, value)| Ok((key.as_str().ok_or(format!("{what}: a key is no text"))?, value))).collect()
}

fn known(node: &Yaml, what: &str, keys: &[&str]) -> Result<(), String> {
    match entries(node, what)?.into_iter().find(|(key, _)| !keys.contains(key)) {
        None => Ok(()),
        Some((key, _)) => Err(format!("{what}: `{key}` is not known")),
    }
}

fn get<'a>(node: &'a Yaml, key: &str, what: &str) -> Result<&'a Yaml<'a>, String> {
    node.as_mapping_get(key).ok_or_else(|| format!("{what}: `{key}` is missing"))
}

/// Texts of a list, at least one.
fn texts<'a>(node: &'a Yaml, what: &str) -> Result<Vec<&'a str>, String> {
    let list = node.as_sequence().filter(|list| !list.is_empty()).ok_or_else(|| format!("{what} is no list"))?;
    list.iter().map(|text| text.as_str().ok_or_else(|| format!("{what}: {text:?} is no text"))).collect()
}

/// The file with this ending that a command writes by `-o`.
fn written<'a>(commands: &[&'a str], ending: &str) -> Result<&'a str, String> {
    let words: Vec<&str> = commands.iter().flat_map(|command| command.split_whitespace()).collect();
    let named = words.windows(2).find(|pair| pair[0] == "-o" && pair[1].ends_with(ending));
    named.map(|pair| pair[1]).ok_or_else(|| format!("no command writes a {ending} file by -o"))
}

const STEP: [&str; 10] =
    ["name", "id", "if", "uses", "run", "with", "env", "shell", "working-directory", "continue-on-error"];

fn github(document: &Yaml) -> Result<(), String> {
    known(document, "the workflow", &["name", "on", "permissions", "env", "defaults", "concurrency", "jobs"])?;
    for (event, _) in entries(get(document, "on", "the workflow")?, "on")? {
        if !["push", "pull_request", "schedule", "workflow_dispatch"].contains(&event) {
            return Err(format!("no event is called `{event}`"));
        }
    }
    for (name, job) in entries(get(document, "jobs", "the workflow")?, "jobs")? {
        known(job, name, &["name", "runs-on", "needs", "if", "env", "permissions", "timeout-minutes", "steps"])?;
        get(job, "runs-on", name)?.as_str().ok_or(format!("{name}: `runs-on` is no text"))?;
        let steps = get(job, "steps", name)?.as_sequence().ok_or(format!("{name}: `steps` is no list"))?;
        let (mut commands, mut kept) = (Vec::new(), Vec::new());
        for step in steps {
            known(step, "a step", &STEP)?;
            let [uses, run] = ["uses", "run"].map(|key| step.as_mapping_get(key).and_then(Yaml::as_str));
            match (uses, run) {
                (Some(uses), None) => {
                    let version = uses.split_once('@').filter(|(action, _)| action.matches('/').count() == 1);
                    let (action, version) = version.ok_or(format!("`{uses}` is no action with its version"))?;
                    if !version.starts_with('v') {
                        return Err(format!("`{uses}` has no version"));
                    }
                    let path = step.as_mapping_get("with").and_then(|with| with.as_mapping_get("path"));
                    if action == "actions/upload-artifact" {
                        kept.push(path.and_then(Yaml::as_str).ok_or("nothing is uploaded")?);
                    }
                    if action == "actions/cache" {
                        let with = get(step, "with", uses)?;
                        get(with, "path", uses)?;
                        get(with, "key", uses)?;
                    }
                }
                (None, Some(run)) => commands.push(run),
                (Some(_), Some(_)) | (None, None) => return Err("a step needs one of `uses` and `run`".into()),
            }
        }
        if !kept.contains(&written(&commands, ".xml")?) {
            return Err("the JUnit file is not kept".into());
        }
        let page = written(&commands, ".md")?;
        let is_shown = |run: &&str| run.contains(page) && run.contains(">> \"$GITHUB_STEP_SUMMARY\"");
        if !commands.iter().any(is_shown) {
            return Err("the Markdown is not shown".into());
        }
    }
    Ok(())
}

const JOB: [&str; 13] = [
    "stage",
    "image",
    "services",
    "variables",
    "cache",
    "needs",
    "rules",
    "before_script",
    "script",
    "after_script",
    "artifacts",
    "tags",
    "timeout",
];

fn gitlab(document: &Yaml) -> Result<(), String> {
    const GLOBAL: [&str; 6] = ["stages", "variables", "cache", "default", "include", "workflow"];
    let stages = texts(get(document, "stages", "the file")?, "stages")?;
    let all = entries(document, "the file")?;
    let jobs: Vec<_> = all.into_iter().filter(|(name, _)| !GLOBAL.contains(name)).collect();
    let names: Vec<&str> = jobs.iter().map(|(name, _)| *name).collect();
    let mut reports = 0;
    for (name, job) in &jobs {
        known(job, name, &JOB)?;
        let stage = get(job, "stage", name)?.as_str().unwrap_or_default();
        if !stages.contains(&stage) {
            return Err(format!("{name}: there is no stage `{stage}`"));
        }
        let script = texts(get(job, "script", name)?, "script")?;
        if let Some(needs) = job.as_mapping_get("needs") {
            let missing = texts(needs, "needs")?.into_iter().find(|need| !names.contains(need));
            missing.map_or(Ok(()), |need| Err(format!("{name}: there is no job `{need}`")))?;
        }
        let Some(artifacts) = job.as_mapping_get("artifacts") else { continue };
        known(artifacts, "artifacts", &["name", "paths", "exclude", "expire_in", "when", "reports"])?;
        // Reports are needed most when a proof fails, so artifacts must always be kept.
        if artifacts.as_mapping_get("when").and_then(Yaml::as_str) != Some("always") {
            return Err(format!("{name}: what a failing job has written is not kept"));
        }
        let reported = get(get(artifacts, "reports", "artifacts")?, "junit", "reports")?.as_str();
        if reported != Some(written(&script, ".xml")?) {
            return Err("the JUnit file is not kept".into());
        }
        if !texts(get(artifacts, "paths", "artifacts")?, "paths")?.contains(&written(&script, ".md")?) {
            return Err("the Markdown is not kept".into());
        }
        reports += 1;
    }
    if reports > 0 { Ok(()) } else { Err("no job has a JUnit report".into()) }
}

#[test]
fn the_ci_files_are_valid_for_their_hosts() {
    let files = blocks(PAGE, "yaml");
    assert_eq!(files.len(), 2, "one for each host");
    for file in files {
        checked(&file).unwrap_or_else(|wrong| panic!("{wrong}:\n{file}"));
    }
}

/// The checks find faults: each edit makes a good file a bad one.
#[test]
fn an_invalid_ci_file_is_refused() {
    let edits = [
        [
            ("runs-on", "runs_on"),
            ("jobs:", "job:"),
            ("on:\n", "when:\n"),
            ("pull_request:", "pull-request:"),
            ("- uses: actions/checkout@v6", "- use: actions/checkout@v6"),
            ("actions/checkout@v6", "checkout"),
            ("run: cargo install", "uses: actions/cache@v5\n        run: cargo install"),
            ("path: linkproof.xml", "path: other.xml"),
            ("cat linkproof.md", "cat other.md"),
            ("          key:", "          keys:"),
            ("    runs-on", "\truns-on"),
        ],
        [
            ("stages: [prove, report]", "stages: [test]"),
            ("stage: report", "stage: reports"),
            ("needs: [prove]", "needs: [proof]"),
            ("  script:\n    - cargo", "  scripts:\n    - cargo"),
            ("junit: linkproof.xml", "junit: other.xml"),
            ("paths: [linkproof.md]", "paths: [other.md]"),
            ("    when: always\n    paths", "    paths"),
            ("reports:\n", "report:\n"),
            ("    - 'curl", "    - curl"),
            ("stages: [prove, report]", "stages: [prove, report"),
            ("image: rust:1.90", "images: rust:1.90"),
        ],
    ];
    for (file, edits) in blocks(PAGE, "yaml").iter().zip(edits) {
        for (old, new) in edits {
            assert!(file.contains(old), "the page does not contain {old}");
            assert!(checked(&file.replacen(old, new, 1)).is_err(), "the checks do not find the fault `{new}`");
        }
    }
}
