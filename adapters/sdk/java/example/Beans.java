import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.function.IntUnaryOperator;
import java.util.function.Supplier;

/** A tiny framework with habits of its own: ids are texts, errors are two exceptions, beans have services and wires. */
final class Beans {
    /** There is no bean, service or wire of that name. */
    static final class Missing extends Exception {
        private static final long serialVersionUID = 1;
    }

    /** Anything else. */
    static final class Trouble extends Exception {
        private static final long serialVersionUID = 1;

        Trouble(String message) {
            super(message);
        }
    }

    /** What beans are made of. */
    interface Bean {
        void prepare();

        void wake(Map<String, IntUnaryOperator> wires);

        void sleep();

        void dispose();

        IntUnaryOperator service(String name);
    }

    private final Map<String, Supplier<Bean>> kinds = new LinkedHashMap<>();
    private final Map<String, Bean> beans = new LinkedHashMap<>();
    private final Map<String, Map<String, IntUnaryOperator>> wires = new LinkedHashMap<>();
    private final List<Bean> awake = new ArrayList<>();

    void define(String kind, Supplier<Bean> make) {
        kinds.put(kind, make);
    }

    void plant(String name, String kind) throws Trouble {
        if (!kinds.containsKey(kind) || !awake.isEmpty()) {
            throw new Trouble("cannot plant " + kind);
        }
        Bean bean = kinds.get(kind).get();
        try {
            bean.prepare();
        } catch (RuntimeException error) {
            throw new Trouble(error.toString());
        }
        beans.put(name, bean);
        wires.put(name, new LinkedHashMap<>());
    }

    Bean bean(String name) throws Missing {
        if (!beans.containsKey(name)) {
            throw new Missing();
        }
        return beans.get(name);
    }

    void pull(String name) throws Missing {
        bean(name).dispose();
        beans.remove(name);
        wires.remove(name);
    }

    void wire(String name, String service, IntUnaryOperator to) throws Missing {
        bean(name);
        wires.get(name).put(service, to);
    }

    void unwire(String name, String service) throws Missing {
        bean(name);
        if (wires.get(name).remove(service) == null) {
            throw new Missing();
        }
    }

    void wake() {
        beans.forEach((name, bean) -> {
            bean.wake(wires.get(name));
            awake.add(bean);
        });
    }

    void sleep() {
        awake.forEach(Bean::sleep);
        awake.clear();
    }
}
