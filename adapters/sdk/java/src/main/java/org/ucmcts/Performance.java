package org.ucmcts;

import java.time.Instant;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import java.util.stream.Stream;

/** One run of one scenario against one adapter. Making it creates the runtime. */
final class Performance<C> {
    private final Adapter<C> adapter;
    private final Node scenario;
    private final Recorder recorder;
    private final Stage stage;
    private final Workers workers;
    private final Variables<C> variables;
    private final Operations<C> operations;
    private final C manager;

    Performance(Adapter<C> adapter, Node scenario, Recorder recorder) throws Exception {
        long patience = Waiting.patience(scenario.number("patience"));
        this.adapter = adapter;
        this.scenario = scenario;
        this.recorder = recorder;
        stage = new Stage(recorder, patience);
        workers = new Workers(patience);
        manager = adapter.createRuntime(stage.implementations(scenario));
        variables = new Variables<>(manager);
        operations = new Operations<>(adapter, scenario, stage, variables, manager, patience);
    }

    /** The events, and the names of the threads that never came back. */
    record Outcome(List<Map<String, Object>> events, List<String> stuck) {}

    /** Takes all steps. */
    Outcome run() {
        int number = 0;
        for (Node step : scenario.nodes("steps")) {
            int own = number++;
            if (step.text("thread") == null) {
                take(own, step);
            } else {
                workers.queue(step.text("thread"), () -> take(own, step));
            }
        }
        stage.gates.openAll();
        List<String> stuck = workers.finish();
        List<Map<String, Object>> events = recorder.stop();
        if (stuck.isEmpty() && !operations.isDestroyed()) { // what a stuck thread holds could block destroy for ever
            try {
                adapter.destroy(manager);
            } catch (Throwable error) {
                // whatever comes of it
            }
        }
        return new Outcome(events, stuck);
    }

    private void take(int number, Node step) {
        switch (step.text("op")) {
            case "open" -> {
                String gate = step.text("gate");
                stage.gates.open(gate, () -> recorder.record("opened", "gate", gate));
            }
            case "reach" ->
                    expect(number, stage.gates.reach(step.text("gate"), step.number("more"), step.number("total")));
            case "join" -> expect(number, workers.join(step.text("worker")));
            case "settle" -> {
                String worker = step.text("worker");
                recorder.record("settled", "worker", worker, "where", workers.settle(worker, stage.gates::isHeld));
            }
            case "pause" -> {
                Waiting.pass(Math.max(step.number("milliseconds"), 0) * 1_000_000);
                recorder.record("paused", "step", number, "calendar", calendar());
            }
            case "await_messages" -> {
                Object[] counted =
                        stage.messages.await(step.text("component"), step.number("instance"), step.number("count"));
                recorder.record("counted", Stream.concat(Stream.of("step", number), Stream.of(counted)).toArray());
            }
            case "stress" -> stress(number, step);
            default -> operations.perform(number, step);
        }
    }

    private void expect(int number, boolean came) {
        if (!came) {
            recorder.record("timeout", "step", number);
        }
    }

    private static long calendar() {
        Instant now = Instant.now();
        return now.getEpochSecond() * 1_000_000_000 + now.getNano();
    }

    private void stress(int number, Node step) {
        List<PortElement> references;
        try {
            references = operations.references(step.texts("refs"));
        } catch (Variables.Unbound missing) {
            recorder.record("skip", "step", number, "variable", missing.getMessage());
            return;
        }
        Occupancy free = new Occupancy();
        Map<Probe, Occupancy> occupancies = new ConcurrentHashMap<>();
        Storm through = new Storm(
                references.stream().<Runnable>map(reference -> () -> reference.exchange(1)).toList(),
                step.number("milliseconds"));
        Storm control = new Storm(
                references.stream().<Runnable>map(reference -> free::visit).toList(), step.number("milliseconds"));
        stage.beginStress(occupancies);
        try {
            through.rage(workers, "stress");
        } finally {
            stage.endStress();
        }
        control.rage(workers, "control");
        recorder.record("stressed",
                "step", number,
                "calls", through.calls(),
                "overlaps", occupancies.values().stream().mapToLong(Occupancy::overlaps).sum(),
                "control_calls", control.calls(),
                "control_overlaps", free.overlaps(),
                "failed", through.failed());
    }
}
