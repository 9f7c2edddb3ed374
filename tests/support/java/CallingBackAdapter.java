import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import org.ucmcts.Adapter;
import org.ucmcts.Body;
import org.ucmcts.Host;
import org.ucmcts.Implementation;
import org.ucmcts.PortElement;
import org.ucmcts.Product;

/** Calls back at once, when it is started, each body that has a timer_callback. */
public final class CallingBackAdapter extends Adapter<String> {
    private List<Implementation> all;

    public static void main(String[] arguments) {
        Host.serve(arguments, new Product("calling back", "0"), CallingBackAdapter::new);
    }

    @Override public String createRuntime(List<Implementation> implementations) { all = implementations; return ""; }

    @Override public void start(String container) {
        for (Implementation one : all) {
            Body body = one.create().get();
            PortElement callback = body.getPolicyPort("itt_timer", "timer_callback");
            boolean isOnly = body.getPolicyPort("clock", "timer_callback") == null
                    && body.getPolicyPort("itt_timer", "timer_service") == null
                    && body.getPolicyPort(null, null) == null;
            if (callback != null && isOnly) {
                callback.call("on_timeout", new ArrayList<>(List.of(List.of(5, "RELATIVE_TIME"), 7)));
            }
        }
    }

    @Override public int addComponent(String container, String name, Map<String, String> attributes) { return 1; }
    @Override public void removeComponent(String container, int component) {}
    @Override public PortElement getPortElement(String container, int component, String port) { return null; }
    @Override public int connect(String container, int component, String port, PortElement to) { return 1; }
    @Override public void disconnect(String container, int connection) {}
    @Override public void stop(String container) {}
    @Override public List<Integer> getComponents(String container) { return List.of(); }
    @Override public String createContainer(String manager) { return ""; }
    @Override public void removeContainer(String manager, String container) {}
    @Override public void destroy(String manager) {}
}
