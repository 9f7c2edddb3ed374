package org.ucmcts;

import java.time.Instant;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import java.util.stream.Stream;
import org.ucmcts.Messages.Scenario;
import org.ucmcts.Messages.Step;

/** One run of one scenario against one adapter. Making it creates the runtime. */
final class Performance<C> {
    private final Adapter<C> adapter;
    private final Scenario scenario;
    private final Recorder recorder;
    private final Stage stage;
    private final Workers workers;
    private final Variables<C> variables;
    private final Operations<C> operations;
    private final C manager;

    Performance(Adapter<C> adapter, Scenario scenario, Recorder recorder) throws Exception {
        long patience = Waiting.patience(scenario.patience());
        this.adapter = adapter;
        this.scenario = scenario;
        this.recorder = recorder;
        stage = new Stage(recorder, patience);
        workers = new Workers(patience);
        manager = adapter.createRuntime(stage.implementations(scenario));
        variables = new Variables<>(manager);
        operations = new Operations<>(adapter, scenario, stage, variables, manager, patience);
    }

    /** The events, and the names of the threads that are stuck. */
    record Outcome(List<Map<String, Object>> events, List<String> stuck) {}

    /** Takes all steps. */
    Outcome run() {
        int number = 0;
        for (Step step : scenario.steps()) {
            int own = number++;
            if (step.thread() == null) {
                take(own, step);
            } else {
                workers.queue(step.thread(), () -> take(own, step));
            }
        }
        stage.gates.openAll();
        List<String> stuck = workers.finish();
        List<Map<String, Object>> events = recorder.stop();
        if (stuck.isEmpty() && !operations.isDestroyed()) { // what a stuck thread holds could block destroy for ever
            try {
                adapter.destroy(manager);
            } catch (Throwable error) {
                // no step of the scenario, so its outcome is not recorded
            }
        }
        return new Outcome(events, stuck);
    }

    private void take(int number, Step step) {
        switch (step.tag()) {
            case "open" -> {
                String gate = step.gate();
                stage.gates.open(gate, () -> recorder.record("opened", "gate", gate));
            }
            case "reach" ->
                    expect(number, stage.gates.reach(step.gate(), step.more(), step.total()));
            case "join" -> expect(number, workers.join(step.worker()));
            case "settle" -> {
                String worker = step.worker();
                recorder.record("settled", "worker", worker, "where", workers.settle(worker, stage.gates::isHeld));
            }
            case "pause" -> {
                Waiting.pass(Math.max(step.milliseconds(), 0) * 1_000_000);
                recorder.record("paused", "step", number, "calendar", calendar());
            }
            case "await_messages" -> {
                Object[] counted =
                        stage.messages.await(step.component(), step.instance(), step.count());
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

    private void stress(int number, Step step) {
        List<PortElement> references;
        try {
            references = operations.references(step.refs());
        } catch (Variables.Unbound missing) {
            recorder.record("skip", "step", number, "variable", missing.getMessage());
            return;
        }
        Occupancy free = new Occupancy();
        Map<Probe, Occupancy> occupancies = new ConcurrentHashMap<>();
        RepeatedCalls through = new RepeatedCalls(
                references.stream().<Runnable>map(reference -> () -> reference.exchange(1)).toList(),
                step.milliseconds());
        RepeatedCalls control = new RepeatedCalls(
                references.stream().<Runnable>map(reference -> free::visit).toList(), step.milliseconds());
        stage.beginStress(occupancies);
        try {
            through.run(workers, "stress");
        } finally {
            stage.endStress();
        }
        control.run(workers, "control");
        recorder.record("stressed",
                "step", number,
                "calls", through.calls(),
                "overlaps", occupancies.values().stream().mapToLong(Occupancy::overlaps).sum(),
                "control_calls", control.calls(),
                "control_overlaps", free.overlaps(),
                "failed", through.failed());
    }
}
