package org.ucmcts;

import java.util.List;

/** What a fragment implements beside {@link Body} (11.2.1.4). */
public interface Fragment {
    /** Gives the fragment access to the container that holds it. */
    void setContainerInterface(ContainerInterface container);

    /** The part of the Container API that every fragment has. */
    @FunctionalInterface
    interface ContainerInterface {
        /** Ids of the container's members. */
        List<Integer> getComponents() throws Exception;
    }
}
